// Segments with vertices between their ends, where light is found: they cast as one, and shadow none of these.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "shadows/groom_gpu.h"
#include "shadows/light_frame.h"
#include "tests/support/lone_strands.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::segment_parts_gpu_test {

namespace {

constexpr std::uint32_t k_parts = 4;
const std::string k_methods[] = {"opacity_map", "deep_opacity", "moments",    "fourier",
                                 "exact_list",  "deep_shadow",  "shadow_map", "voxel"};

using tests::device;

/// Every segment in k_parts.
strands::Groom cut(const strands::Groom& groom) {
  strands::Groom parts;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v)
      for (std::uint32_t k = 0; k < (v + 1 < groom.offsets[s + 1] ? k_parts : 1); ++k) {
        const std::uint32_t next = std::min(v + 1, groom.offsets[s + 1] - 1);
        const float share = float(k) / float(k_parts);
        parts.positions.push_back(glm::mix(groom.positions[v], groom.positions[next], share));
        parts.radii.push_back(std::lerp(groom.radii[v], groom.radii[next], share));
      }
    parts.offsets.push_back(std::uint32_t(parts.positions.size()));
  }
  return parts;
}

std::vector<float> transmittance(GroomOnDevice& on_device, const std::string& method, const LightSource& light) {
  const std::string set = method == "voxel" ? "resolution=64" : "resolution=512";
  const auto shadow = (*find_gpu_method(method))->create(device(), tests::values_of(method, set).value()).value();
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(shadow->record(commands, on_device.strands, 1, light, on_device.transmittance));
  EXPECT_TRUE(device()->submit(std::move(commands)));
  return gpu::read_buffer<float>(*device(), on_device.transmittance, on_device.strands.vertex_count).value();
}

/// The cut groom, whose parts cast as one.
std::unique_ptr<GroomOnDevice> upload_cut(const strands::Groom& groom, const std::optional<glm::vec3>& viewer) {
  auto on_device = upload_groom(*device(), cut(groom)).value();
  on_device->strands.segment_parts = k_parts;
  on_device->strands.segment_count /= k_parts;
  on_device->strands.seen_from = viewer;
  return on_device;
}

}  // namespace

// Measured: 0.
TEST(SegmentParts, AtTheEndsOfSegments_LightIsThatOfWholeOnes) {
  const strands::Groom groom = tests::coat(1500, 5, 0.03, 2e-4f, 5), parts_of = cut(groom);
  const LightSource light{{1, 1, 0.3}};
  const std::optional<glm::vec3> viewer = glm::vec3(0.2f, 0.1f, 0.3f);
  const auto whole = upload_groom(*device(), groom).value();
  whole->strands.seen_from = viewer;
  const auto parts = upload_cut(groom, viewer);
  for (const std::string& method : k_methods) {
    const std::vector<float> expected = transmittance(*whole, method, light),
                             found = transmittance(*parts, method, light);
    double different = 0, mean = 0;
    for (std::size_t s = 0; s < groom.strand_count(); ++s)
      for (std::size_t k = 0; k < groom.strand_size(s); ++k) {
        const float wanted = expected[groom.offsets[s] + k];
        different += double(std::abs(found[parts_of.offsets[s] + k * k_parts] - wanted));
        mean += double(wanted);
      }
    fmt::print("{}: mean {:.4f}, different by {:.2g}\n", method, mean / double(expected.size()),
               different / double(expected.size()));
    EXPECT_LT(different / double(expected.size()), 1e-6) << method;
    EXPECT_LT(mean / double(expected.size()), 0.9) << method;  // something is shadowed
  }
}

TEST(SegmentParts, OfLoneStrands_AreLitAtEveryPart) {
  const auto on_device = upload_cut(tests::lone_strands().groom, {});
  for (const std::string& method : k_methods) {
    const double left = tests::mean(transmittance(*on_device, method, {{0, 1, 0}}));
    fmt::print("{}: {:.4f}\n", method, left);
    EXPECT_GT(left, 0.995) << method;
  }
}

}  // namespace cuticle::shadows::segment_parts_gpu_test
