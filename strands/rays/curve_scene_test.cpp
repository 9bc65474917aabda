// RayScene of curves: hits against a brute-force loop over small spheres along them, and on fibres whose hits are
// known.
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/rays/curve_span.h"
#include "strands/rays/ray_scene.h"
#include "strands/rays/test_strands.h"

namespace cuticle::strands::curve_scene_test {
namespace {

std::unique_ptr<RayScene> scene_of(const Groom& groom, std::string_view kind) {
  auto scene = RayScene::build(groom, {}, {}, curve_kind(kind));
  EXPECT_TRUE(scene.ok());
  return std::move(scene).value();
}

/// The spans of a strand as curve_kind.h states them.
std::vector<CurveSpan> spans_of(const Groom& groom, std::uint32_t strand, SplineBasis basis) {
  std::vector<glm::dvec4> points;
  for (std::uint32_t v = groom.offsets[strand]; v < groom.offsets[strand + 1]; ++v)
    points.emplace_back(groom.positions[v], groom.radii[v]);
  std::vector<CurveSpan> spans;
  if (basis == SplineBasis::bezier) {
    for (std::size_t k = 0; k + 3 < points.size(); k += 3)
      spans.push_back(curve_span(basis, {points[k], points[k + 1], points[k + 2], points[k + 3]}));
    return spans;
  }
  const glm::dvec4 before = 2.0 * points[0] - points[1], after = 2.0 * points.back() - points[points.size() - 2];
  points.insert(points.begin(), before);
  points.push_back(after);
  for (std::size_t k = 0; k + 3 < points.size(); ++k)
    spans.push_back(curve_span(basis, {points[k], points[k + 1], points[k + 2], points[k + 3]}));
  return spans;
}

/// Where the ray first enters one of 1,200 spheres along a span from the side.
double entry_by_force(const CurveSpan& span, const TestRay& ray) {
  double first = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 1200; ++k) {
    const glm::dvec4 sphere = span.at(k / 1200.0);
    const glm::dvec3 away = ray.origin - glm::dvec3(sphere);
    const double middle = glm::dot(away, ray.direction);
    const double square = middle * middle - glm::dot(away, away) + sphere.w * sphere.w;
    if (!(square > 0)) continue;
    const double entry = -middle - std::sqrt(square);
    const glm::dvec3 normal = glm::normalize(away + entry * ray.direction);
    const bool is_cap = std::abs(glm::dot(normal, glm::normalize(glm::dvec3(span.slope(k / 1200.0))))) > 0.05;
    if (!is_cap) first = std::min(first, entry);
  }
  return first;
}

/// Rays past the control points of a groom, some of them beside the fibres.
std::vector<TestRay> rays_past(const Groom& groom, int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<TestRay> rays;
  for (int k = 0; k < count; ++k) {
    const std::size_t v = random() % groom.vertex_count();
    const glm::dvec3 direction = glm::normalize(glm::dvec3{unit(random), unit(random), unit(random)});
    const glm::dvec3 aside = 4e-4 * glm::dvec3{unit(random), unit(random), unit(random)};
    rays.push_back({glm::dvec3(groom.positions[v]) + aside - 0.3 * direction, direction});
  }
  return rays;
}

/// Where one Bezier curve ends and the next begins, their control points lie on a line.
void make_smooth(Groom& groom) {
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s] + 3; v + 1 < groom.offsets[s + 1]; v += 3)
      groom.positions[v] = (groom.positions[v - 1] + groom.positions[v + 1]) / 2.0f;
}

/// Rays of 300 that meet another distance than by force, nothing in the place of something, or the reverse.
int wrong_rays(std::string_view name) {
  Groom groom = random_coils(60, 3e-4f);
  const CurveKind kind = curve_kind(name);
  if (kind.basis == SplineBasis::bezier) make_smooth(groom);
  const auto scene = scene_of(groom, name);
  std::vector<CurveSpan> spans;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (const CurveSpan& span : spans_of(groom, s, kind.basis)) spans.push_back(span);
  int wrong = 0, hits = 0;
  for (const TestRay& ray : rays_past(groom, 300)) {
    double expected = std::numeric_limits<double>::infinity();
    for (const CurveSpan& span : spans) {
      const glm::dvec3 away = glm::dvec3(span.at(0.5)) - ray.origin;
      if (glm::length(glm::cross(away, ray.direction)) < 4e-3) expected = std::min(expected, entry_by_force(span, ray));
    }
    const RayHit hit = scene->closest(ray.origin, ray.direction);
    wrong += std::isfinite(expected) ? !(std::abs(hit.distance - expected) < 2e-7) : std::isfinite(hit.distance);
    hits += std::isfinite(expected);
  }
  EXPECT_GT(hits, 150) << name;
  return wrong;
}

TEST(CurveScene, RoundCurves_AreMetWhereSpheresAlongThemAre) {
  for (const char* name : {"round_bezier", "round_b_spline", "round_catmull_rom"}) {
    EXPECT_EQ(wrong_rays(name), 0) << name;
  }
}

/// A quarter of a circle of 2 cm in 13 vertices.
Groom arc() {
  std::vector<glm::vec3> strand;
  for (int i = 0; i <= 12; ++i) {
    const float turn = 0.13f * float(i);
    strand.emplace_back(0.02f * std::sin(turn), 0.02f * (1 - std::cos(turn)), 0);
  }
  return groom_of({strand}, 1e-4f);
}

TEST(CurveScene, RayThatLeavesAFibre_DoesNotMeetItAgain) {
  const Groom groom = arc();
  for (const std::string_view name : curve_kind_names()) {
    if (curve_kind(name).is_cone()) continue;
    const auto scene = scene_of(groom, name);
    int met = 0;
    for (int i = 1; i < 40; ++i) {
      const glm::dvec3 middle = 0.5 * glm::dvec3(groom.positions[6] + groom.positions[7]);
      const glm::dvec3 origin = middle + glm::dvec3(0, 9.5e-5 * (i / 20.0 - 1), 1);
      const RayHit hit = scene->closest(origin, {0, 0, -1});
      if (hit.kind != RayHit::Kind::fibre) continue;
      ++met;
      const FibreLeft from{hit.strand, hit.vertex, hit.share};
      const glm::dvec3 begin = origin - glm::dvec3(0, 0, hit.distance);
      for (const glm::dvec3& to : {glm::dvec3(0, 0, 1), {0, 0, -1}, {0, -1, 0}, {0.8, -0.6, 0}, {0.6, 0, -0.8}})
        EXPECT_EQ(scene->closest(begin, to, from).kind, RayHit::Kind::nothing) << name << " " << i;
    }
    EXPECT_GT(met, 20) << name;
  }
}

TEST(CurveScene, RayAlongTheChordOfAnArc_MeetsItsOtherEnd) {
  const Groom groom = arc();
  const auto scene = scene_of(groom, "round_catmull_rom");
  const glm::dvec3 begin = groom.positions[1], end = groom.positions[11];
  const glm::dvec3 along = glm::normalize(end - begin),
                   origin = begin + 1.5e-4 * glm::normalize(glm::dvec3(-begin.y, 0.02, 0));
  const RayHit hit = scene->closest(origin, along, {0, 1, 0});
  ASSERT_EQ(hit.kind, RayHit::Kind::fibre);
  EXPECT_GE(hit.vertex, 9u);
}

TEST(CurveScene, HitOnACurve_TellsItsMiddle) {
  const Groom groom = arc();
  for (const char* name : {"flat_linear", "round_bezier", "flat_bezier", "round_b_spline", "flat_catmull_rom"}) {
    const auto scene = scene_of(groom, name);
    const glm::dvec3 beside = glm::mix(glm::dvec3(groom.positions[7]), glm::dvec3(groom.positions[8]), 0.3);
    const glm::dvec3 origin = beside + glm::dvec3(0, 3e-5, 1);
    const RayHit hit = scene->closest(origin, {0, 0, -1});
    ASSERT_EQ(hit.kind, RayHit::Kind::fibre) << name;
    const CurvePoint middle = scene->curve_at(hit);
    EXPECT_NEAR(glm::distance(middle.position, beside), 0, 1.2e-4) << name;
    EXPECT_NEAR(middle.radius, 1e-4, 1e-10) << name;
    const glm::dvec3 away = origin - glm::dvec3(0, 0, hit.distance) - middle.position;
    EXPECT_NEAR(glm::dot(away, glm::normalize(middle.tangent)), 0, 1e-9) << name;
    if (curve_kind(name).is_flat) continue;
    EXPECT_NEAR(glm::length(away), 1e-4, 1e-10) << name;
  }
}

TEST(CurveScene, BezierStrandOfFiveVertices_IsRefused) {
  const Groom groom = groom_of(
      {{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}}, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 4, 0}}}, 0.01f);
  const auto scene = RayScene::build(groom, {}, {}, curve_kind("round_bezier"));
  ASSERT_FALSE(scene.ok());
  EXPECT_NE(scene.error().message.find("strand 1 has 5 vertices"), std::string::npos) << scene.error().message;
}

}  // namespace
}  // namespace cuticle::strands::curve_scene_test
