// Hair on a head of one's own: the mesh is brought to where the procedural head stands.
#include "strands/growing/mesh_head.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace cuticle::strands::mesh_head_test {
namespace {

/// The procedural head, of another size and elsewhere.
Mesh moved(float scale, const glm::vec3& shift) {
  Mesh mesh = make_head(60).mesh;
  for (glm::vec3& point : mesh.positions) point = scale * point + shift;
  return mesh;
}

TEST(MeshHead, AScaledAndMovedHead_ComesBackToItsPlace) {
  const Head own = make_head(60);
  const auto head = head_of_mesh(moved(1.3f, {0.02f, -0.4f, 0.05f}), 60);
  ASSERT_TRUE(head) << head.error().message;
  float farthest = 0;
  for (std::size_t v = 0; v < own.mesh.positions.size(); ++v)
    farthest = std::max(farthest, glm::distance(own.mesh.positions[v], head->mesh.positions[v]));
  EXPECT_LT(farthest, 1e-3f);
  ASSERT_EQ(head->scalp.positions.size(), own.scalp.positions.size());
  for (std::size_t v = 0; v < own.scalp.positions.size(); ++v)
    EXPECT_LT(glm::distance(own.scalp.positions[v], head->scalp.positions[v]), 1.5e-3f) << v;
}

TEST(MeshHead, Colliders_LieWithinTheMesh) {
  const auto head = head_of_mesh(moved(0.8f, {0, 0.1f, 0}), 60);
  ASSERT_TRUE(head) << head.error().message;
  ASSERT_EQ(head->colliders.size(), 5u);
  for (const Sphere& sphere : head->colliders) {
    EXPECT_GT(sphere.radius, 0.02);
    for (const glm::vec3& point : head->mesh.positions)
      ASSERT_GE(glm::distance(glm::dvec3(point), sphere.center), sphere.radius - 1e-6);
  }
}

TEST(MeshHead, AFlatPlate_IsRefused) {
  Mesh plate;
  for (int k = 0; k < 16; ++k) plate.positions.emplace_back(0.1f * float(k % 4), 0, 0.1f * float(k / 4));
  plate.triangles = {{0, 4, 1}, {1, 4, 5}};
  plate.normals.assign(plate.positions.size(), glm::vec3(0, 1, 0));
  const auto head = head_of_mesh(plate);
  ASSERT_FALSE(head);
  EXPECT_THAT(head.error().message, testing::HasSubstr("head.mesh"));
}

TEST(MeshHead, WithoutNormals_IsRefused) {
  Mesh mesh = moved(1, {0, 0, 0});
  mesh.normals.clear();
  EXPECT_FALSE(head_of_mesh(mesh));
}

}  // namespace
}  // namespace cuticle::strands::mesh_head_test
