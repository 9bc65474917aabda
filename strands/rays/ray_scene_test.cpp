// RayScene against a brute-force loop over round cones in double, and on scenes whose hits are known.
#include "strands/rays/ray_scene.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "strands/rays/round_cone.h"
#include "strands/rays/test_strands.h"

namespace cuticle::strands::ray_scene_test {
namespace {

std::unique_ptr<RayScene> scene_of(const Groom& groom, std::span<const Mesh> surfaces = {}) {
  auto scene = RayScene::build(groom, surfaces);
  EXPECT_TRUE(scene.ok());
  return std::move(scene).value();
}

/// Coils that taper by half.
Groom tapered_coils(std::size_t count, float radius) {
  Groom groom = random_coils(count, radius);
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) groom.radii[v] *= 1 - 0.02f * float(v % 25);
  return groom;
}

double nearest_by_force(const Groom& groom, const TestRay& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto sphere = [&](std::uint32_t v) { return glm::vec4(groom.positions[v], groom.radii[v]); };
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v) {
      const LineInterval inside = round_cone_interval(ray.origin, ray.direction, sphere(v), sphere(v + 1));
      if (inside.first > 0 && inside.first < inside.last) nearest = std::min(nearest, inside.first);
    }
  return nearest;
}

TEST(RayScene, Coils_NearestHitIsThatOfBruteForce) {
  const Groom groom = tapered_coils(500, 2e-4f);
  const auto scene = scene_of(groom);
  int hits = 0;
  for (const TestRay& ray : slab_rays(1200)) {
    const double expected = nearest_by_force(groom, ray);
    const RayHit hit = scene->closest(ray.origin, ray.direction);
    EXPECT_EQ(hit.kind == RayHit::Kind::fibre, std::isfinite(expected));
    if (hit.kind != RayHit::Kind::fibre) continue;
    ++hits;
    EXPECT_EQ(hit.distance, expected);
    EXPECT_TRUE(scene->is_blocked(ray.origin, ray.direction, expected + 1e-9));
    EXPECT_FALSE(scene->is_blocked(ray.origin, ray.direction, expected - 1e-9));
  }
  EXPECT_GT(hits, 200);
}

TEST(RayScene, RayThatLeavesAFibre_MeetsItsOtherSegmentsOnlyWhereItComesBack) {
  // A hairpin: along x, up, and back.
  const Groom groom =
      groom_of({{{-0.1f, 0, 0}, {-0.05f, 0, 0}, {0, 0, 0}, {0.05f, 0, 0}, {0.1f, 0.001f, 0}, {0, 0.02f, 0}}}, 1e-4f);
  const auto scene = scene_of(groom);
  const glm::dvec3 begin(0.0252, -1e-4, 0);  // on the side that looks down
  const FibreLeft from{0, 2};
  const RayHit through = scene->closest(begin, {0, 1, 0}, from);
  ASSERT_EQ(through.kind, RayHit::Kind::fibre) << "up through the fibre to the part that comes back";
  EXPECT_EQ(through.vertex, 4u);
  const glm::dvec3 along = glm::normalize(glm::dvec3(0.02, 1e-4, 0));
  const RayHit leaning = scene->closest(begin, along, from);
  EXPECT_EQ(leaning.kind, RayHit::Kind::nothing) << "out of the joint's sphere, past the bend";
  EXPECT_EQ(scene->closest(begin, {0, -1, 0}, from).kind, RayHit::Kind::nothing);
}

TEST(RayScene, RayAlongItsOwnStraightFibre_MeetsNothing) {
  std::vector<glm::vec3> strand;
  for (int i = 0; i <= 40; ++i) strand.emplace_back(0.005f * float(i), 0, 0);
  const auto scene = scene_of(groom_of({strand}, 1e-3f));
  for (double lean : {-1e-3, -1e-2, -0.1, 0.0, 1e-3, 1e-2}) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1, lean, 0));
    EXPECT_EQ(scene->closest({0.0526, 1e-3, 0}, direction, {0, 10}).kind, RayHit::Kind::nothing) << lean;
    EXPECT_FALSE(scene->is_blocked({0.0526, 1e-3, 0}, direction, 10, {0, 10})) << lean;
  }
}

TEST(RayScene, RayInsideAFibre_MeetsItNoMore) {
  const auto scene = scene_of(groom_of({{{0, -1, 0}, {0, 1, 0}}}, 0.01f));
  EXPECT_EQ(scene->closest({0, 0, 0}, {1, 0, 0}).kind, RayHit::Kind::nothing);
  EXPECT_NEAR(scene->closest({-0.02, 0, 0}, {1, 0, 0}).distance, 0.01, 1e-9);
}

TEST(RayScene, Surface_IsMetWithItsBarycentricsAndNotLeftTwice) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0.5f}, {1, 0, 0.5f}, {0, 1, 0.5f}};
  mesh.triangles = {{0, 1, 2}};
  const auto scene = scene_of(groom_of({{{-1, 0.2f, 0.7f}, {1, 0.2f, 0.7f}}}, 0.01f), std::span(&mesh, 1));
  const RayHit hit = scene->closest({0.3, 0.2, 0}, {0, 0, 1});
  ASSERT_EQ(hit.kind, RayHit::Kind::surface);
  EXPECT_EQ(hit.surface, 0u);
  EXPECT_NEAR(hit.distance, 0.5, 1e-6);
  EXPECT_NEAR(hit.barycentrics.x, 0.3, 1e-6);
  EXPECT_NEAR(hit.barycentrics.y, 0.2, 1e-6);
  EXPECT_EQ(scene->closest({0.3, 0.2, 0.5}, {0, 0, 1}).kind, RayHit::Kind::fibre);
  EXPECT_EQ(scene->closest({0.3, 0.2, 1}, {0, 0, -1}).kind, RayHit::Kind::fibre);
  EXPECT_FALSE(scene->is_blocked({0.3, 0.4, 0}, {0, 0, 1}, 0.4));
  EXPECT_TRUE(scene->is_blocked({0.3, 0.4, 0}, {0, 0, 1}, 0.6));
}

TEST(RayScene, NoStrands_NothingIsMet) {
  EXPECT_EQ(scene_of(Groom{})->closest({0, 0, 0}, {0, 0, 1}).kind, RayHit::Kind::nothing);
}

}  // namespace
}  // namespace cuticle::strands::ray_scene_test
