// H15 on the device: its packed strands, unpacked by the CPU, against those that were given.
#include "strands/packing/packing_gpu.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "gpu/tests/test_device.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::strands::packing_gpu_test {
namespace {

constexpr std::uint32_t k_strands = 3000, k_vertices = 30;

/// A coat; its strand 7 is one place.
Groom coat() {
  Groom groom = tests::coat(k_strands, int(k_vertices), 0.2, 4e-5f, 9);
  for (std::size_t v = groom.offsets[7]; v < groom.offsets[8]; ++v) groom.positions[v] = {0.1f, 0.2f, 0.3f};
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) groom.radii[v] *= 1 - 0.5f * float(v % k_vertices) / 29;
  return groom;
}

PackedGroom packed_on_device(const Groom& groom) {
  const auto& device = tests::device();
  std::vector<glm::vec4> vertices, along;
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) vertices.emplace_back(groom.positions[v], groom.radii[v]);
  for (const glm::vec3& tangent : tangents(groom)) along.emplace_back(tangent, 0);
  const gpu::Buffer given = *gpu::make_buffer_from<glm::vec4>(*device, vertices),
                    given_tangents = *gpu::make_buffer_from<glm::vec4>(*device, along);
  GpuPacking packing = *GpuPacking::create(*device, k_strands, k_vertices);
  gpu::Commands commands = device->record();
  packing.record(commands, given, given_tangents);
  const auto cost = device->submit(std::move(commands));
  EXPECT_TRUE(cost.ok()) << (cost ? "" : cost.error().message);
  return {groom.offsets, *gpu::read_buffer<PackedStrand>(*device, packing.strands(), k_strands),
          *gpu::read_buffer<PackedVertex>(*device, packing.vertices(), groom.vertex_count())};
}

TEST(GpuPacking, Coat_IsWithinTheBoundsOfTheCpu) {
  const Groom groom = coat();
  const PackedGroom packed = packed_on_device(groom);
  const Groom back = unpacked(packed);
  const std::vector<glm::vec3> given = tangents(groom), got = unpacked_tangents(packed);
  double position = 0, radius = 0, tangent = 0;
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) {
    const double extent = double(packed.strands[v / k_vertices].half_extent);
    const double apart = glm::distance(glm::dvec3(back.positions[v]), glm::dvec3(groom.positions[v]));
    position = std::max(position, extent > 0 ? (apart - 1e-7) / extent : apart);
    radius = std::max(radius, std::abs(double(back.radii[v]) / double(groom.radii[v]) - 1));
    tangent = std::max(tangent, std::asin(glm::length(glm::cross(glm::dvec3(given[v]), glm::dvec3(got[v])))));
  }
  RecordProperty("position_over_extent", std::to_string(position));
  RecordProperty("tangent_1e6", std::to_string(1e6 * tangent));
  EXPECT_LT(position, 2 * std::sqrt(3.0) * k_packed_position_error);
  EXPECT_LT(radius, 0x1p-10);
  EXPECT_LT(tangent, k_packed_tangent_error);
}

}  // namespace
}  // namespace cuticle::strands::packing_gpu_test
