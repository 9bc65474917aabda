// Maps larger than the device's largest buffer come in strips of rows, with the same transmittance.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "shadows/groom_gpu.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::map_strips_gpu_test {

namespace {

using tests::device;

constexpr glm::dvec3 k_to_light{0.6, 0.8, 0};
constexpr double k_alpha = 0.4;

std::uint64_t words_of(const std::string& method, const registry::ParameterValues& values) {
  const std::string layers = method == "deep_opacity" ? "layers" : method == "opacity_map" ? "slices" : "";
  const std::uint64_t numbers = layers.empty() ? 7 : std::uint64_t(values.integer(layers)),
                      side = std::uint64_t(values.integer("resolution"));
  return numbers * side * side;
}

/// Submissions until the map has room, at most 9; its last note in `note`.
int submit_until_it_holds(GpuShadow& shadow, const GroomOnDevice& on_device, std::string& note) {
  for (int submissions = 1; submissions < 10; ++submissions) {
    gpu::Commands commands = device()->record();
    EXPECT_TRUE(shadow.record(commands, on_device.strands, k_alpha, {k_to_light}, on_device.transmittance));
    EXPECT_TRUE(device()->submit(std::move(commands)));
    const MapRoom room = shadow.settle().value();
    note = room.note;
    if (room.holds) return submissions;
  }
  return 10;
}

struct DeviceRun {
  double difference = 1;  ///< the largest of T at the vertices between the device and the CPU
  int submissions = 0;
  std::uint32_t dispatches = 0;  ///< of a frame, at the end
  std::string note;
};
DeviceRun run(const std::string& method, const std::string& set, std::size_t strands = 300) {
  const strands::Groom groom = tests::coat(strands, 8, 0.03, 1e-4f, 5);
  const tests::VertexReceivers receivers = tests::vertex_receivers(groom);
  const auto values = tests::values_of(method, set).value();
  const auto shadow = (*find_gpu_method(method))->create(device(), values);
  EXPECT_TRUE(shadow) << (shadow ? "" : shadow.error().message);
  if (!shadow) return {};
  const auto on_device = upload_groom(*device(), groom).value();
  DeviceRun result{0, 0, (*shadow)->dispatches_per_frame(on_device->strands), {}};
  result.submissions = submit_until_it_holds(**shadow, *on_device, result.note);
  result.dispatches = (*shadow)->dispatches_per_frame(on_device->strands);
  const auto found = gpu::read_buffer<float>(*device(), on_device->transmittance, groom.vertex_count()).value();
  const auto twin =
      (*find_method(method))->evaluate({&groom, k_alpha, k_to_light}, receivers.of(groom), values).value();
  for (std::size_t v = 0; v < found.size(); ++v)
    result.difference = std::max(result.difference, std::abs(double(found[v]) - double(twin.values[v])));
  return result;
}

}  // namespace

TEST(MapStrips, LargerThanABuffer_AgreeWithTheCpu) {
  if (!device()->info().is_software) GTEST_SKIP() << "one buffer of a GPU holds them";
  for (const auto& [method, set] : {std::pair<std::string, std::string>{"deep_opacity", "layers=16,resolution=2048"},
                                    {"deep_opacity", "layers=16,resolution=2048,storage=bytes,filter_texels=3"},
                                    {"deep_opacity", "layers=12,resolution=2048,tiles=sparse,tile_share=0.5"},
                                    {"opacity_map", "slices=20,resolution=2048,filter_texels=2"},
                                    {"fourier", "harmonics=3,resolution=2304"}}) {
    ASSERT_GT(4 * words_of(method, tests::values_of(method, set).value()), device()->info().max_storage_buffer_bytes);
    const DeviceRun found = run(method, set);
    std::printf("%s %s: %.2g\n", method.c_str(), set.c_str(), found.difference);
    EXPECT_LT(found.difference, 2e-5) << method << " " << set;
  }
}

TEST(MapRoom, ListsBeyondTheirRoom_ComeInStripsWithEqualShadow) {
  for (const std::string method : {"exact_list", "deep_shadow"}) {
    const DeviceRun small = run(method, "resolution=512,room_mib=1", 5000), large = run(method, "resolution=512", 5000);
    std::printf("%s: %d submissions, %u dispatches; %u with room\n", method.c_str(), small.submissions,
                small.dispatches, large.dispatches);
    EXPECT_LT(small.difference, 4e-5) << method;  // knots have 65,535 steps
    EXPECT_EQ(small.difference, large.difference) << method;
    EXPECT_GT(small.dispatches, 2 * large.dispatches) << method;
    EXPECT_LT(small.submissions, 5) << method;
    EXPECT_EQ(small.note, "") << method;
    EXPECT_EQ(large.submissions, 1) << method;
  }
}

/// More than the 16 MiB that lists begin with.
TEST(MapRoom, MoreFragmentsThanTheFirstRoom_TakeMoreMemory) {
  const DeviceRun found = run("exact_list", "resolution=2048", 6500);
  std::printf("%d submissions, %u dispatches\n", found.submissions, found.dispatches);
  EXPECT_EQ(found.submissions, 2);
  EXPECT_LT(found.difference, 2e-5);
}

/// Sparse tiles, whose room is given.
TEST(MapRoom, WhatFindsNoRoom_IsSaid) {
  const DeviceRun tiles = run("deep_opacity", "resolution=256,tiles=sparse,tile_share=0.05");
  std::printf("%s\n", tiles.note.c_str());
  EXPECT_EQ(tiles.note.find("deep_opacity: "), 0u);
  EXPECT_EQ(tiles.submissions, 1);
  EXPECT_EQ(run("deep_opacity", "resolution=256,tiles=sparse,tile_share=1").note, "");
}

}  // namespace cuticle::shadows::map_strips_gpu_test
