// Segments with vertices between their ends, where light is found: they cast as one, and shadow none of these.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

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

std::string sharp(const std::string& method) { return method == "voxel" ? "resolution=64" : "resolution=512"; }

std::vector<float> transmittance(GroomOnDevice& on_device, const std::string& method, const std::string& set,
                                 const LightSource& light, double alpha = 1) {
  const auto shadow = (*find_gpu_method(method))->create(device(), tests::values_of(method, set).value()).value();
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(shadow->record(commands, on_device.strands, alpha, light, on_device.transmittance));
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

/// The vertices of cut(groom) as points on the segments of `groom`.
struct OnSegments {
  std::vector<glm::vec3> points;
  std::vector<SegmentPlace> places;
  std::vector<std::uint32_t> strands, vertices;
  Receivers receivers() const { return {points, strands, places, vertices}; }
};
OnSegments on_segments(const strands::Groom& groom) {
  OnSegments found;
  found.points = cut(groom).positions;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t i = 0; i <= k_parts * (groom.strand_size(s) - 1); ++i) {
      const std::uint32_t from = std::min(groom.offsets[s] + i / k_parts, groom.offsets[s + 1] - 2);
      found.strands.push_back(std::uint32_t(s));
      found.vertices.push_back(groom.offsets[s] + i / k_parts);
      found.places.push_back({groom.positions[from], groom.positions[from + 1],
                              float(groom.offsets[s] * k_parts + i - from * k_parts) / float(k_parts)});
    }
  return found;
}

/// The mean and the largest difference.
std::pair<double, double> differences(std::span<const float> a, std::span<const float> b) {
  double mean = 0, most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(double(a[i]) - double(b[i]));
    mean += difference / double(a.size());
    most = difference <= most ? most : difference;  // NaN is taken
  }
  return {mean, most};
}

}  // namespace

// N19: between the ends of segments, tent weights of a vertex's own depth or of the ends'; where strands run along the
// light through all planes, the kinds differ.
TEST(SegmentParts, EitherTentWeights_AgreeWithTheCpu) {
  const std::tuple<strands::Groom, LightSource, double> cases[] = {
      {tests::coat(1500, 8, 0.03, 1e-4f, 5), {{1, 1, 0.3}}, 0}, {tests::along_the_light(), {{0, 1, 0}}, 0.01}};
  for (const auto& [groom, light, least_difference] : cases) {
    const auto on_device = upload_cut(groom, {});
    const OnSegments places = on_segments(groom);
    for (const std::string form : {"compute,between=even", "graphics_8bit"}) {
      std::vector<float> of_kind[2];
      for (const int per_vertex : {0, 1}) {
        const std::string set =
            "resolution=96,form=" + form + ",weights=" + (per_vertex ? "per_vertex" : "per_fragment");
        of_kind[per_vertex] = transmittance(*on_device, "opacity_map", set, light, 0.4);
        const auto values = tests::values_of("opacity_map", set).value();
        const Casters casters{&groom, 0.4, light.to_light, light.position};
        const auto cpu = (*find_method("opacity_map"))->evaluate(casters, places.receivers(), values).value();
        const auto [mean, most] = differences(of_kind[per_vertex], cpu.values);
        fmt::print("{}: from the CPU by {:.2g} in the mean, {:.2g} at most\n", set, mean, most);
        EXPECT_LT(most, 1e-5) << set;
      }
      const auto [mean, most] = differences(of_kind[0], of_kind[1]);
      fmt::print("weights per vertex change T by {:.5f} in the mean, {:.4f} at most\n", mean, most);
      EXPECT_GT(mean, least_difference) << form;
    }
  }
}

// Measured: 0.
TEST(SegmentParts, AtTheEndsOfSegments_LightIsThatOfWholeOnes) {
  const strands::Groom groom = tests::coat(1500, 5, 0.03, 2e-4f, 5), parts_of = cut(groom);
  const LightSource light{{1, 1, 0.3}};
  const std::optional<glm::vec3> viewer = glm::vec3(0.2f, 0.1f, 0.3f);
  const auto whole = upload_groom(*device(), groom).value();
  whole->strands.seen_from = viewer;
  const auto parts = upload_cut(groom, viewer);
  for (const std::string& method : k_methods) {
    const std::vector<float> expected = transmittance(*whole, method, sharp(method), light),
                             found = transmittance(*parts, method, sharp(method), light);
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
    const double left = tests::mean(transmittance(*on_device, method, sharp(method), {{0, 1, 0}}));
    fmt::print("{}: {:.4f}\n", method, left);
    EXPECT_GT(left, 0.995) << method;
  }
}

}  // namespace cuticle::shadows::segment_parts_gpu_test
