// RayGroom against a brute-force loop over capsules in double, and on strands whose crossings are known.
#include "strands/rays/rays.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <thread>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "strands/rays/test_strands.h"

namespace cuticle::strands::rays_test {
namespace {

std::vector<Crossing> crossings_of(const Groom& groom, const glm::dvec3& origin, const glm::dvec3& direction) {
  const auto rays = RayGroom::build(groom);
  EXPECT_TRUE(rays.ok());
  std::vector<Crossing> crossings;
  (*rays)->all_crossings(origin, direction, crossings);
  return crossings;
}

/// Least distance of the ray to the segment a-b: dense in neither, exact by the two-parameter minimum.
double ray_segment_distance(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& a,
                            const glm::dvec3& b) {
  const glm::dvec3 edge = b - a, offset = origin - a;
  const double e = glm::dot(edge, edge), f = glm::dot(edge, offset), c = glm::dot(direction, offset),
               g = glm::dot(direction, edge);
  const double determinant = e - g * g;
  double along = determinant > 1e-18 ? (f - g * c) / determinant : 0;
  along = std::clamp(along, 0.0, 1.0);
  const double t = std::max(0.0, along * g - c);
  along = std::clamp((f + t * g) / e, 0.0, 1.0);
  return glm::length(offset + direction * t - edge * along);
}

std::set<std::uint32_t> brute_force(const Groom& groom, const glm::dvec3& origin, const glm::dvec3& direction) {
  std::set<std::uint32_t> strands;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
      if (ray_segment_distance(origin, direction, groom.positions[v], groom.positions[v + 1]) < double(groom.radii[v]))
        strands.insert(s);
  return strands;
}

/// Bent strands of four segments, scattered in a slab 0.1 x 0.1 x 0.02 m.
Groom random_slab(std::size_t count, float radius) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<std::vector<glm::vec3>> strands(count);
  for (auto& strand : strands) {
    glm::vec3 point(0.1f * unit(random), 0.1f * unit(random), 0.02f * unit(random));
    glm::vec3 direction(unit(random) - 0.5f, unit(random) - 0.5f, 0.2f * (unit(random) - 0.5f));
    for (int i = 0; i < 5; ++i) {
      strand.push_back(point);
      direction += 0.4f * glm::vec3(unit(random) - 0.5f, unit(random) - 0.5f, 0);
      point += 0.008f * glm::normalize(direction);
    }
  }
  return groom_of(strands, radius);
}

/// Rays of `count` that cross other strands than a brute-force loop finds.
int wrong_rays(const Groom& groom, int count) {
  const auto rays = RayGroom::build(groom).value();
  std::size_t hits = 0;
  int wrong = 0;
  std::vector<Crossing> crossings;
  for (const TestRay& ray : slab_rays(count)) {
    rays->all_crossings(ray.origin, ray.direction, crossings);
    std::set<std::uint32_t> found;
    for (const Crossing& crossing : crossings) found.insert(crossing.strand);
    wrong += found != brute_force(groom, ray.origin, ray.direction);
    hits += found.size();
  }
  EXPECT_GT(hits, std::size_t(count) / 4);  // the slab is not empty air
  return wrong;
}

TEST(RayGroom, RandomSlab_SameStrandsAsBruteForce) { EXPECT_EQ(wrong_rays(random_slab(1500, 1e-4f), 3000), 0); }

TEST(RayGroom, CurledStrands_SameStrandsAsBruteForce) { EXPECT_EQ(wrong_rays(random_coils(500, 2e-4f), 2000), 0); }

TEST(RayGroom, TaperedFibre_EntryAndExitLieOnTheCone) {
  Groom groom = groom_of({{{0, 0, 0}, {1, 0, 0}}}, 0.1f);
  groom.radii[1] = 0.02f;
  // The cone that touches both spheres: at x it is wide by (0.1 - 0.08 x) / cos, sin = 0.08.
  const double radius = (0.1 - 0.08 * 0.5) / std::sqrt(1 - 0.08 * 0.08);
  const auto crossings = crossings_of(groom, {0.5, -1, 0}, {0, 1, 0});
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_NEAR(crossings[0].entry, 1 - radius, 1e-6);
  EXPECT_NEAR(crossings[0].exit, 1 + radius, 1e-6);
  EXPECT_EQ(crossings_of(groom, {0.5, -1, 0}, {0, -1, 0}).size(), 0u) << "behind the ray";
  // The sphere reaches to the circle that the cone touches it in, at x = 0.1 x 0.08.
  const auto on_sphere = crossings_of(groom, {0.004, -1, 0}, {0, 1, 0});
  ASSERT_EQ(on_sphere.size(), 1u);
  EXPECT_NEAR(on_sphere[0].exit - on_sphere[0].entry, 2 * std::sqrt(0.01 - 0.004 * 0.004), 1e-6);
}

TEST(RayGroom, StraightFibre_EntryAndExitAreOneDiameterApart) {
  const Groom groom = groom_of({{{0, -1, 0}, {0, 1, 0}}}, 0.01f);
  const auto crossings = crossings_of(groom, {0, 0.2, -1}, {0, 0, 1});
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_NEAR(double(crossings[0].entry), 0.99, 1e-5);
  EXPECT_NEAR(double(crossings[0].exit), 1.01, 1e-5);
}

TEST(RayGroom, RayThroughJointOfBentStrand_CountsOnce) {
  const Groom groom = groom_of({{{-0.1f, 0, 0}, {0, 0, 0}, {0, 0.1f, 0}}}, 0.005f);
  for (double offset : {-0.003, 0.0, 0.003})
    EXPECT_EQ(crossings_of(groom, {offset, offset, -1}, {0, 0, 1}).size(), 1u) << offset;
}

TEST(RayGroom, RayAlongManyJoints_CountsOnce) {
  std::vector<glm::vec3> strand;
  for (int i = 0; i <= 20; ++i) strand.emplace_back(0, 0, 0.005f * float(i));
  EXPECT_EQ(crossings_of(groom_of({strand}, 0.004f), {0.001, 0.001, -1}, {0, 0, 1}).size(), 1u);
}

TEST(RayGroom, StrandCrossingTheRayTwice_CountsTwice) {
  const Groom groom = groom_of({{{-0.1f, 0, 0}, {0.1f, 0, 0}, {0.1f, 0, 0.1f}, {-0.1f, 0, 0.1f}}}, 0.002f);
  const auto crossings = crossings_of(groom, {0, 0, -1}, {0, 0, 1});
  ASSERT_EQ(crossings.size(), 2u);
  EXPECT_NEAR(double(crossings[0].entry), 0.998, 1e-5);
  EXPECT_NEAR(double(crossings[1].entry), 1.098, 1e-5);
}

TEST(RayGroom, RayPastTheTip_HitsTheRoundCapOnly) {
  const Groom groom = groom_of({{{0, 0, 0}, {0, 0.1f, 0}}}, 0.01f);
  EXPECT_EQ(crossings_of(groom, {0, 0.105, -1}, {0, 0, 1}).size(), 1u);
  EXPECT_EQ(crossings_of(groom, {0, 0.111, -1}, {0, 0, 1}).size(), 0u);
}

TEST(RayGroom, OriginInsideAFibre_EntryIsZero) {
  const Groom groom = groom_of({{{0, -1, 0}, {0, 1, 0}}}, 0.01f);
  const auto crossings = crossings_of(groom, {0, 0, 0}, {0, 0, 1});
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_EQ(crossings[0].entry, 0.0f);
  EXPECT_NEAR(double(crossings[0].exit), 0.01, 1e-6);
}

TEST(RayGroom, OverlappingStrands_SortedByEntryThenStrand) {
  const std::vector<glm::vec3> near = {{0, -1, 0}, {0, 1, 0}}, far = {{0, -1, 0.5f}, {0, 1, 0.5f}};
  const auto crossings = crossings_of(groom_of({far, near, near}, 0.01f), {0, 0, -1}, {0, 0, 1});
  ASSERT_EQ(crossings.size(), 3u);
  EXPECT_EQ(crossings[0].strand, 1u);
  EXPECT_EQ(crossings[1].strand, 2u);
  EXPECT_EQ(crossings[2].strand, 0u);
}

TEST(RayGroom, StrandWithCoincidentPoints_CrossedOnce) {
  const Groom groom = groom_of({{{0, -1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 1, 0}}}, 0.01f);
  EXPECT_EQ(crossings_of(groom, {0, 0, -1}, {0, 0, 1}).size(), 1u);
}

// A point of smoke: a segment without a length is a sphere.
TEST(RayGroom, SegmentWithoutALength_IsASphere) {
  const Groom groom = groom_of({{{0, -1, 0}, {0, 1, 0}}, {{0.5f, 0, 0}, {0.5f, 0, 0}}}, 0.01f);
  const auto crossings = crossings_of(groom, {0.506, 0, -1}, {0, 0, 1});
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_EQ(crossings[0].strand, 1u);
  EXPECT_NEAR(crossings[0].exit - crossings[0].entry, 0.016, 1e-6);
  EXPECT_EQ(crossings_of(groom, {0.5105, 0, -1}, {0, 0, 1}).size(), 0u);
}

TEST(RayGroom, TwoThreads_SameCrossingsAsOne) {
  const Groom groom = random_slab(500, 1e-4f);
  const auto rays = RayGroom::build(groom);
  ASSERT_TRUE(rays.ok());
  const auto trace = [&](std::vector<Crossing>& all) {
    std::vector<Crossing> crossings;
    for (const TestRay& ray : slab_rays(500)) {
      (*rays)->all_crossings(ray.origin, ray.direction, crossings);
      all.insert(all.end(), crossings.begin(), crossings.end());
    }
  };
  std::vector<Crossing> first, second, alone;
  std::thread a(trace, std::ref(first)), b(trace, std::ref(second));
  a.join();
  b.join();
  trace(alone);
  const auto equal = [](const Crossing& x, const Crossing& y) {
    return x.strand == y.strand && x.entry == y.entry && x.exit == y.exit;
  };
  EXPECT_TRUE(std::equal(first.begin(), first.end(), alone.begin(), alone.end(), equal));
  EXPECT_TRUE(std::equal(second.begin(), second.end(), alone.begin(), alone.end(), equal));
}

}  // namespace
}  // namespace cuticle::strands::rays_test
