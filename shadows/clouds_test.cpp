// N20: smoke as points and foliage as segments, through the maps that hair uses.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shadows/clouds.h"
#include "tests/support/shadow_runs.h"

namespace cuticle::shadows::clouds_test {

namespace {

constexpr double k_sigma = 0.05;
constexpr std::size_t k_puffs = 40000, k_leaves = 60000;

/// Puffs of 0.4 mm, and needles 6 mm long and 0.2 mm thick, with a deviation of 50 mm.
const strands::Groom& smoke_ball() {
  static const strands::Groom groom = smoke(k_puffs, k_sigma, 4e-4f);
  return groom;
}
const strands::Groom& leaf_crown() {
  static const strands::Groom groom = foliage(k_leaves, k_sigma, 0.006, 1e-4f);
  return groom;
}
/// Mean projected area of a caster: the disc of a puff; a convex body's is a quarter of its surface.
double puff_area() { return std::numbers::pi * 4e-4 * 4e-4; }
double leaf_area() { return std::numbers::pi * 1e-4 * (2 * 0.006 + 4 * 1e-4) / 4; }

/// Points behind the cloud, within 8 mm of its middle line.
std::vector<glm::vec3> behind() {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 256; ++i) points.emplace_back(0.001 * (i % 16 - 7.5), -0.5, 0.001 * (i / 16 - 7.5));
  return points;
}
/// exp(-alpha areas per area) for `count` casters of this area along the middle line of the cloud.
double expected(double count, double area, double alpha) {
  return std::exp(-alpha * count * area / (2 * std::numbers::pi * k_sigma * k_sigma));
}
double measured(std::string_view method, const strands::Groom& cloud, const std::string& set, double alpha) {
  return tests::mean(tests::run_shadow(method, cloud, behind(), set, alpha)->values);
}
constexpr const char* k_map = "resolution=128,filter_radius_mm=10,accumulate=poisson";

}  // namespace

TEST(Clouds, SmokeThroughEveryOpacityMap_FollowsTheExponentialLaw) {
  for (const char* method : {"opacity_map", "deep_opacity", "moments", "fourier"})
    EXPECT_NEAR(measured(method, smoke_ball(), k_map, 0.3) / expected(k_puffs, puff_area(), 0.3), 1, 0.05) << method;
}

TEST(Clouds, FoliageThroughEveryOpacityMap_FollowsTheExponentialLaw) {
  for (const char* method : {"opacity_map", "deep_opacity", "moments", "fourier"})
    EXPECT_NEAR(measured(method, leaf_crown(), k_map, 0.3) / expected(k_leaves, leaf_area(), 0.3), 1, 0.05) << method;
}

TEST(Clouds, Truth_SeesSmokeAndFoliageAsTheMapsDo) {
  if (!find_method("truth")) GTEST_SKIP() << "this build has no Embree";
  constexpr const char* k_rays = "rays=256,footprint_radius_mm=10";
  EXPECT_NEAR(measured("truth", leaf_crown(), k_rays, 0.3) / expected(k_leaves, leaf_area(), 0.3), 1, 0.05);
  EXPECT_NEAR(measured("truth", smoke_ball(), k_rays, 0.3) / expected(k_puffs, puff_area(), 0.3), 1, 0.05);
}

TEST(Clouds, InTheMiddle_HalfTheDepthCounts) {
  const std::vector<glm::vec3> middle(1, glm::vec3(0));
  const std::string set = "slices=32,resolution=64,filter_radius_mm=15,accumulate=poisson";
  const auto half = tests::run_shadow("opacity_map", smoke_ball(), middle, set, 0.3);
  EXPECT_NEAR(double(half->values[0]) / std::sqrt(expected(k_puffs, puff_area(), 0.3)), 1, 0.06);
}

TEST(PointCasters, OnePoint_CoversItsDisc) {
  const glm::vec3 points[] = {{0, 0.05f, 0}, {0.05f, 0, 0.05f}, {-0.05f, 0, -0.05f}};
  const float radii[] = {0.005f, 0.0001f, 0.0001f};
  const strands::Groom groom = point_casters(points, radii);
  ASSERT_EQ(groom.strand_count(), 3u);
  EXPECT_NEAR(tests::shadow_at("opacity_map", groom, {0, -0.01f, 0}), 0.6, 1e-4);
  EXPECT_EQ(tests::shadow_at("opacity_map", groom, {0.01f, -0.01f, 0}), 1.0f);
}

}  // namespace cuticle::shadows::clouds_test
