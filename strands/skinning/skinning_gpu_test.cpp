// The device's skinning and carrying against the CPU's.
#include "strands/skinning/skinning_gpu.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/random.h"
#include "gpu/tests/test_device.h"
#include "strands/binding/carry_gpu.h"
#include "tests/support/device_bound.h"

namespace cuticle::strands::skinning_gpu_test {
namespace {

/// A wavy sheet of 60 x 60 vertices, half a metre wide.
Mesh sheet() {
  Mesh mesh;
  constexpr std::uint32_t side = 60;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const float x = float(i % side) / (side - 1), y = float(i / side) / (side - 1);
    mesh.positions.emplace_back(0.5f * x, 0.05f * std::sin(9 * x) * std::cos(7 * y), 0.5f * y);
    if (i % side == side - 1 || i / side == side - 1) continue;
    mesh.triangles.push_back({i, i + side, i + 1});
    mesh.triangles.push_back({i + 1, i + side, i + side + 1});
  }
  compute_normals(mesh);
  return mesh;
}

constexpr std::size_t k_joints = 40;

std::vector<Influences> random_influences(std::size_t count) {
  RandomStream random(5);
  std::vector<Influences> all(count);
  for (Influences& one : all) {
    glm::vec4 weights(0);
    for (int k = 0; k < 4; ++k) {
      one.joints[std::size_t(k)] = std::uint32_t(random.next_unit() * k_joints);
      weights[k] = k == 3 ? 0.0f : float(random.next_unit()) + (k == 0 ? 1.0f : 0.0f);
    }
    one.weights = weights / (weights.x + weights.y + weights.z);
  }
  return all;
}

std::vector<JointMotion> random_motions() {
  RandomStream random(6);
  const auto number = [&] { return 2 * random.next_unit() - 1; };
  std::vector<glm::dmat4> matrices;
  for (std::size_t j = 0; j < k_joints; ++j) {
    const glm::dmat4 shifted = glm::translate(glm::dmat4(1), 0.2 * glm::dvec3(number(), number(), number()));
    const glm::dmat4 turned = glm::rotate(shifted, 1.5 * number(), glm::normalize(glm::dvec3(number(), number(), 1.5)));
    matrices.push_back(glm::scale(turned, glm::dvec3(1 + 0.3 * number(), 1, 1 + 0.3 * number())));
  }
  return joint_motions(matrices);
}

/// Two hundred strands of 5 vertices, standing on the sheet.
Groom strands_on(const Mesh& mesh, std::span<const Root> roots) {
  Groom groom;
  for (const Root& root : roots) {
    const auto& t = mesh.triangles[root.triangle];
    glm::vec3 place(0);
    for (int k = 0; k < 3; ++k) place += mesh.positions[t[std::size_t(k)]] * root.weights[k];
    for (int i = 0; i < 5; ++i)
      groom.positions.push_back(place + 0.01f * float(i) * glm::vec3(0.3f, 1, 0.1f * float(i)));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.vertex_count(), 3e-5f);
  return groom;
}

void expect_near(std::span<const glm::vec4> device, std::span<const glm::vec3> host, float bound) {
  ASSERT_EQ(device.size(), host.size());
  float largest = 0;
  for (std::size_t i = 0; i < host.size(); ++i)
    largest = std::max(largest, glm::distance(glm::vec3(device[i]), host[i]));
  EXPECT_LT(largest, bound);
}

class SkinningOnDevice : public testing::TestWithParam<Skinning> {};

TEST_P(SkinningOnDevice, MeshAndStrands_AreThoseOfTheCpu) {
  const auto& device = tests::device();
  const Mesh mesh = sheet();
  const auto influences = random_influences(mesh.positions.size());
  const auto motions = random_motions();
  const auto roots = scatter_roots(mesh, 200, 7);
  const RestOnMesh rest = rest_on_mesh(strands_on(mesh, roots), mesh, roots);
  auto skinned = GpuSkin::create(*device, mesh, influences, k_joints, std::vector<float>(mesh.positions.size(), 0.75f));
  auto carried = GpuCarry::create(*device, rest);
  ASSERT_TRUE(skinned && carried);
  gpu::Commands commands = device->record();
  ASSERT_TRUE(skinned->record(commands, motions, GetParam()));
  carried->record(commands, skinned->positions(), skinned->normals());
  const auto cost = device->submit(std::move(commands));
  ASSERT_TRUE(cost) << cost.error().message;

  Mesh moved;
  skin(mesh, influences, motions, GetParam(), moved);
  std::vector<glm::vec3> places(rest.locals.size());
  carry(rest, moved, places);
  const auto positions = gpu::read_buffer<glm::vec4>(*device, skinned->positions(), mesh.positions.size());
  const auto normals = gpu::read_buffer<glm::vec4>(*device, skinned->normals(), mesh.positions.size());
  const auto strands = gpu::read_buffer<glm::vec4>(*device, carried->positions(), places.size());
  ASSERT_TRUE(positions && normals && strands);
  EXPECT_EQ((*positions)[17].w, 0.75f);
  const float bound = float(tests::bound_for(*device, 1e-6, 1.6e-6));
  expect_near(*positions, moved.positions, bound);
  expect_near(*normals, moved.normals, 2e-5f);
  expect_near(*strands, places, bound);
}

INSTANTIATE_TEST_SUITE_P(Methods, SkinningOnDevice, testing::Values(Skinning::linear_blend, Skinning::dual_quaternion));

}  // namespace
}  // namespace cuticle::strands::skinning_gpu_test
