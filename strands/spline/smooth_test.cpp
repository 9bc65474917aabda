// N4, N5 on the CPU: 7 control vertices to 36 (or any number), and three smoothed hairs to one between them.
#include <cmath>

#include <gtest/gtest.h>

#include "strands/spline/smooth.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::strands::smooth_test {
namespace {

/// Seven points on a quarter circle of radius 1.
Groom quarter_circle() {
  Groom groom;
  for (int i = 0; i < 7; ++i) {
    const double angle = i / 6.0 * std::acos(0.0);
    groom.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  groom.offsets.push_back(7);
  groom.radii.assign(7, 0.5f);
  return groom;
}

TEST(Smoothing, SevenControls_BecomeThirtySixVertices) {
  const Groom smoothed = smooth(quarter_circle(), 36);
  EXPECT_EQ(smoothed.vertex_count(), 36u);
  EXPECT_TRUE(validate(smoothed).ok());
}

TEST(Smoothing, AnyRatio_KeepsBothEndPoints) {
  const Groom control = quarter_circle();
  for (int vertices : {2, 3, 7, 30, 36, 64}) {
    const Groom smoothed = smooth(control, vertices);
    EXPECT_EQ(smoothed.positions.front(), control.positions.front()) << vertices;
    EXPECT_EQ(smoothed.positions.back(), control.positions.back()) << vertices;
  }
}

TEST(Smoothing, ControlPoints_LieOnTheCurve) {
  const Groom control = quarter_circle(), smoothed = smooth(control, 37);  // 6 steps per segment
  for (std::size_t i = 0; i < 7; ++i) EXPECT_LT(glm::distance(smoothed.positions[6 * i], control.positions[i]), 1e-6f);
}

/// Largest distance from the unit circle between control points `first` and `last`.
double off_circle(const Groom& smoothed, std::size_t first, std::size_t last) {
  double worst = 0;
  for (std::size_t i = 10 * first; i <= 10 * last; ++i)
    worst = std::max(worst, std::abs(1 - double(glm::length(smoothed.positions[i]))));
  return worst;
}

TEST(Smoothing, PointsOnACircle_InnerSegmentsFollowIt) {
  const double sagitta = 1 - std::cos(std::acos(0.0) / 12);  // 8.6e-3: what straight segments miss
  const Groom smoothed = smooth(quarter_circle(), 61);
  EXPECT_LT(off_circle(smoothed, 1, 5), 0.1 * sagitta);
  EXPECT_LT(off_circle(smoothed, 0, 6), sagitta);  // the end segments have their chord for a tangent
}

TEST(Smoothing, UnevenSegments_NeitherLoopNorOvershoot) {
  Groom control;
  tests::add_strand(control, {{0, 0, 0}, {0, 0.01f, 0}, {0.01f, 0.5f, 0}, {0.3f, 0.55f, 0}}, 0.1f);
  const Groom smoothed = smooth(control, 64);
  for (std::size_t i = 1; i < smoothed.vertex_count(); ++i)
    EXPECT_GT(glm::dot(smoothed.positions[i] - smoothed.positions[i - 1], glm::vec3(1, 1, 0)), 0) << i;
}

TEST(Smoothing, TwoPoints_StayStraight) {
  Groom control;
  tests::add_strand(control, {{0, 0, 0}, {3, 6, 9}}, 0.1f);
  for (const glm::vec3& p : smooth(control, 20).positions)
    EXPECT_LT(glm::length(glm::cross(p, glm::normalize(glm::vec3(1, 2, 3)))), 1e-5f);
}

TEST(Smoothing, OnePointAndCoincidentPoints_AreFinite) {
  Groom control;
  tests::add_strand(control, {{1, 2, 3}}, 0.1f);
  tests::add_strand(control, {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, 0.1f);
  const Groom smoothed = smooth(control, 9);
  ASSERT_EQ(smoothed.vertex_count(), 18u);
  for (const glm::vec3& p : smoothed.positions) EXPECT_EQ(p, glm::vec3(1, 2, 3));
}

TEST(Smoothing, Radii_AreInterpolated) {
  Groom control;
  tests::add_strand(control, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, 0);
  control.radii = {4, 2, 1};
  const Groom smoothed = smooth(control, 5);
  EXPECT_EQ(smoothed.radii, (std::vector<float>{4, 3, 2, 1.5f, 1}));
}

struct ScalpOfOneTriangle {
  Mesh scalp{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}};
  Groom hairs;
  std::vector<std::uint32_t> hair_of_vertex{0, 1, 2};
  ScalpOfOneTriangle() {
    for (const glm::vec3& p : scalp.positions) tests::add_strand(hairs, {p, p + glm::vec3(0, 0, 1 + p.x)}, 0.25f);
  }
};

TEST(Interpolation, RootAtACorner_IsThatHair) {
  const ScalpOfOneTriangle s;
  const std::vector<Root> roots = {{0, {0, 1, 0}}};
  const Groom drawn = interpolate(s.hairs, s.scalp, roots, s.hair_of_vertex);
  EXPECT_EQ(drawn.positions[1], s.hairs.positions[3]);
}

TEST(Interpolation, Weights_BlendThreeHairs) {
  const ScalpOfOneTriangle s;
  const std::vector<Root> roots = {{0, {0.5f, 0.25f, 0.25f}}};
  const Groom drawn = interpolate(s.hairs, s.scalp, roots, s.hair_of_vertex);
  EXPECT_EQ(drawn.positions[0], glm::vec3(0.25f, 0.25f, 0));
  EXPECT_EQ(drawn.positions[1], glm::vec3(0.25f, 0.25f, 1.25f));
  EXPECT_EQ(drawn.root_barycentrics[0], glm::vec2(0.25f, 0.25f));
  EXPECT_TRUE(validate(drawn).ok());
}

TEST(Interpolation, PublishedSizes_4095StrandsOf36And30) {
  const Head head = make_head();
  const Groom control = plant_control_hairs(head, Style()).value();
  std::vector<std::uint32_t> hairs(head.scalp.positions.size());
  for (std::size_t v = 0; v < hairs.size(); ++v) hairs[v] = std::uint32_t(v);
  const auto roots = scatter_roots(head.scalp, 4095, 1);
  EXPECT_EQ(interpolate(smooth(control, 36), head.scalp, roots, hairs).vertex_count(), 147420u);
  EXPECT_EQ(interpolate(smooth(control, 30), head.scalp, roots, hairs).vertex_count(), 122850u);
}

}  // namespace
}  // namespace cuticle::strands::smooth_test
