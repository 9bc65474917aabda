// The frame and the offset h of what a ray meets.
#include "render/reference/fibre_point.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::render::reference::fibre_point_test {
namespace {

strands::Groom curved_fibre() {
  strands::Groom hair;
  for (int i = 0; i <= 42; ++i) {
    const float turn = 0.01f * float(i);
    hair.positions.emplace_back(std::sin(turn), 0.2f * turn, 1 - std::cos(turn));
  }
  hair.radii.assign(hair.positions.size(), 8e-5f);
  hair.offsets = {0, std::uint32_t(hair.positions.size())};
  return hair;
}

/// Chi-squared of the offsets of parallel rays, in 20 bins of h.
double unevenness(strands::CurveKind kind) {
  const strands::Groom hair = curved_fibre();
  const auto tangents = strands::tangents(hair);
  const auto scene = strands::RayScene::build(hair, {}, {}, kind).value();
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.15, -0.3, 1));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int k_bins = 20;
  std::vector<int> counts(k_bins, 0);
  int hits = 0;
  for (int i = 0; i < 200000; ++i) {
    // Beside an even point of the axis, farther than the fibre is wide and curves lie beside their control points.
    const std::size_t segment = 4 + std::size_t(unit(random) * 32);
    const glm::dvec3 begin = hair.positions[segment], axis = glm::dvec3(hair.positions[segment + 1]) - begin;
    const glm::dvec3 side = glm::normalize(glm::cross(direction, axis));
    const glm::dvec3 origin = begin + unit(random) * axis - direction + (3e-4 * unit(random) - 1.5e-4) * side;
    const strands::RayHit hit = scene->closest(origin, direction);
    if (hit.kind != strands::RayHit::Kind::fibre) continue;
    const double h = kind.is_cone() ? fibre_point(hair, tangents, hit, origin, direction).h
                                    : fibre_point(scene->curve_at(hit), kind.is_flat, hit, origin, direction).h;
    EXPECT_LE(std::abs(h), 1);
    ++counts[std::size_t(std::min(k_bins - 1, int((h + 1) / 2 * k_bins)))];
    ++hits;
  }
  EXPECT_GT(hits, 90000);
  double chi_squared = 0;
  for (const int count : counts) chi_squared += std::pow(count - hits / double(k_bins), 2) / (hits / double(k_bins));
  return chi_squared;
}

TEST(FibrePoint, ParallelLight_OffsetsAreEvenOnEveryKindOfCurve) {
  for (const std::string_view name : strands::curve_kind_names())  // 19 degrees of freedom: one in a thousand is above
    EXPECT_LT(unevenness(strands::curve_kind(name)), 43.8) << name;
}

// docs/conventions.md: the viewer's ray meets the fibre at azimuth phi_o + asin h.
TEST(FibrePoint, NormalOfTheHit_HasTheAzimuthThatTheOffsetSays) {
  const strands::Groom hair = curved_fibre();
  const auto tangents = strands::tangents(hair);
  const auto scene = strands::RayScene::build(hair, {}).value();
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.1, 0.3, -1));
  for (const double offset : {-7e-5, -4e-5, 0.0, 3e-5, 7.5e-5}) {
    const glm::dvec3 axis_point = 0.5 * glm::dvec3(hair.positions[20] + hair.positions[21]);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(hair.positions[21] - hair.positions[20]));
    const glm::dvec3 origin = axis_point - direction + offset * glm::normalize(glm::cross(axis, -direction));
    const strands::RayHit hit = scene->closest(origin, direction);
    ASSERT_EQ(hit.kind, strands::RayHit::Kind::fibre);
    const FibrePoint point = fibre_point(hair, tangents, hit, origin, direction);
    EXPECT_NEAR(point.h, offset / 8e-5, 1e-4);
    const glm::dvec3 away = point.position - axis_point;
    const glm::vec3 normal = point.local(glm::normalize(away - glm::dot(away, axis) * axis));
    const glm::vec3 viewer = point.local(-direction);
    const double turn = std::atan2(double(normal.z), double(normal.y)) - std::atan2(double(viewer.z), double(viewer.y));
    EXPECT_NEAR(std::sin(turn), point.h, 1e-4);
  }
}

TEST(FibrePoint, Frame_IsRightHandedAndAlongTheFibre) {
  const strands::Groom hair = curved_fibre();
  const auto tangents = strands::tangents(hair);
  const auto scene = strands::RayScene::build(hair, {}).value();
  const glm::dvec3 origin = glm::dvec3(hair.positions[10]) + glm::dvec3(0, 0, -1), direction(0, 0, 1);
  const strands::RayHit hit = scene->closest(origin, direction);
  const FibrePoint point = fibre_point(hair, tangents, hit, origin, direction);
  EXPECT_NEAR(glm::distance(glm::cross(point.x, point.y), point.z), 0, 1e-12);
  EXPECT_NEAR(glm::distance(point.x, glm::dvec3(tangents[10])), 0, 1e-4);
  EXPECT_NEAR(glm::distance(point.world(point.local({0.6, 0, 0.8})), glm::dvec3(0.6, 0, 0.8)), 0, 1e-6);
}

TEST(FibrePoint, RayAlongTheFibre_HasNoOffset) {
  strands::Groom hair;
  hair.positions = {{0, 0, 0}, {0, 0, 1}};
  hair.radii = {1e-3f, 1e-3f};
  hair.offsets = {0, 2};
  const strands::RayHit hit{.kind = strands::RayHit::Kind::fibre, .distance = 0.999};
  const FibrePoint point = fibre_point(hair, strands::tangents(hair), hit, {1e-4, 2e-4, -1}, {0, 0, 1});
  EXPECT_EQ(point.h, 0);
  EXPECT_EQ(point.x, glm::dvec3(0, 0, 1));
}

}  // namespace
}  // namespace cuticle::render::reference::fibre_point_test
