// Fox.glb of CUTICLE_TEST_DATA: counts as its README states them; fur stays on the skin over all of the Run clip.
#include <cstdlib>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/binding/binding.h"
#include "strands/binding/nearest_triangle.h"
#include "strands/character/character.h"
#include "strands/spline/smooth.h"

namespace cuticle::strands::fox_test {
namespace {

const Character& fox() {
  static const Character character =
      read_character(std::string(std::getenv("CUTICLE_TEST_DATA")) + "/motion/gltf/Fox.glb").value();
  return character;
}

double diagonal(const Mesh& mesh) {
  glm::vec3 lower = mesh.positions.front(), upper = lower;
  for (const glm::vec3& p : mesh.positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  return double(glm::distance(lower, upper));
}

Mesh posed(Skinning method, double time) {
  Mesh moved = fox().mesh;
  const int run = find_clip(fox(), "Run").value();
  skin(fox().mesh, fox().influences, joint_motions(joint_matrices(fox(), run, time)), method, moved);
  return moved;
}

TEST(Fox, Counts_AreThoseOfTheReadme) {
  EXPECT_EQ(fox().report.file_vertices, 1728u);
  EXPECT_EQ(fox().mesh.triangles.size() + fox().report.degenerate_triangles, 576u);
  EXPECT_LT(fox().mesh.positions.size(), 400u);
  EXPECT_EQ(fox().joints.size(), 24u);
  EXPECT_EQ(fox().metres_per_unit, 0.01);
  for (const auto& [name, seconds] : {std::pair("Survey", 3.42), {"Walk", 0.71}, {"Run", 1.16}})
    EXPECT_NEAR(fox().clips[std::size_t(find_clip(fox(), name).value())].duration, seconds, 0.005);
}

TEST(Fox, BindPoseAtRest_IsThePoseOfTheMesh) {
  // The rest pose of the nodes is the bind pose: matrices do nothing.
  Mesh moved;
  skin(fox().mesh, fox().influences, joint_motions(joint_matrices(fox(), -1, 0)), Skinning::linear_blend, moved);
  double largest = 0;
  for (std::size_t v = 0; v < moved.positions.size(); ++v)
    largest = std::max(largest, double(glm::distance(moved.positions[v], fox().mesh.positions[v])));
  EXPECT_LT(largest, 1e-5 * diagonal(fox().mesh));
}

class FoxRuns : public testing::TestWithParam<Skinning> {};

/// Drawn fur: three control hairs per triangle, on its corners, mixed by barycentrics.
TEST_P(FoxRuns, RootsOfDrawnFur_NeverLeaveTheSkin) {
  Groom guides;
  for (std::size_t v = 0; v < fox().mesh.positions.size(); ++v) {
    for (int i = 0; i < 3; ++i)
      guides.positions.push_back(fox().mesh.positions[v] + 0.01f * float(i) * fox().mesh.normals[v]);
    guides.offsets.push_back(std::uint32_t(guides.positions.size()));
  }
  guides.radii.assign(guides.vertex_count(), 3e-5f);
  const auto binding = bind_roots(guides, fox().mesh, 1e-4);
  ASSERT_TRUE(binding);
  const RestOnMesh rest = rest_on_mesh(guides, fox().mesh, binding->roots);
  const auto drawn = scatter_roots(fox().mesh, 3000, 11);
  std::vector<std::uint32_t> hairs(guides.strand_count());
  for (std::uint32_t v = 0; v < hairs.size(); ++v) hairs[v] = v;
  double largest = 0;
  for (int frame = 0; frame < 35; ++frame) {
    const Mesh moved = posed(GetParam(), frame / 30.0);
    carry(rest, moved, guides.positions);
    const Groom fur = interpolate(smooth(guides, 5), fox().mesh, drawn, hairs);
    const NearestTriangle nearest(moved);
    for (std::size_t s = 0; s < fur.strand_count(); ++s)
      largest = std::max(largest, nearest.at(glm::dvec3(fur.strand(s)[0])).distance / diagonal(moved));
  }
  RecordProperty("largest_distance_over_diagonal", std::to_string(largest));
  EXPECT_LT(largest, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Methods, FoxRuns, testing::Values(Skinning::linear_blend, Skinning::dual_quaternion));

}  // namespace
}  // namespace cuticle::strands::fox_test
