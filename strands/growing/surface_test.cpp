#include "strands/growing/surface.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/random.h"
#include "strands/growing/growing.h"

namespace cuticle::strands {
namespace {

SurfaceHit by_all_vertices(const Mesh& mesh, double reach, const glm::dvec3& point) {
  double squared = reach * reach;
  SurfaceHit hit{reach, {0, 1, 0}};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::dvec3 offset = point - glm::dvec3(mesh.positions[v]), normal(mesh.normals[v]);
    if (glm::dot(offset, offset) >= squared) continue;
    squared = glm::dot(offset, offset);
    hit = {glm::dot(offset, normal), normal};
  }
  return hit;
}

// Points within the head, beside it, beyond its grid of cells and beyond any reach.
TEST(NearestSurface, AnyPoint_FindsWhatAllVerticesSay) {
  const Mesh mesh = make_head(100).mesh;
  RandomStream random{7};
  for (const double reach : {0.002, 0.02, 0.05, 0.3}) {
    const NearestSurface surface(mesh, reach);
    int near = 0;
    for (int k = 0; k < 500; ++k) {
      const double size = k % 5 == 0 ? 3 : 0.3;
      const glm::dvec3 point =
          size * (glm::dvec3(random.next_unit(), random.next_unit(), random.next_unit()) - 0.5) + glm::dvec3(0, 0.1, 0);
      const SurfaceHit found = surface.at(point), wanted = by_all_vertices(mesh, reach, point);
      ASSERT_EQ(found.distance, wanted.distance) << reach << ", point " << k;
      ASSERT_EQ(found.normal, wanted.normal);
      near += int(found.distance < reach);
    }
    EXPECT_GT(near, 0) << reach;
    EXPECT_LT(near, 500) << reach;
  }
}

TEST(NearestSurface, MeshWithoutVertices_IsOutOfReach) {
  const Mesh none;
  EXPECT_EQ(NearestSurface(none, 0.1).at({0, 0, 0}).distance, 0.1);
}

}  // namespace
}  // namespace cuticle::strands
