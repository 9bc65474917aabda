// Maps larger than the device's largest buffer come in strips of rows, with the same transmittance.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "shadows/groom_gpu.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::map_strips_gpu_test {

namespace {

std::shared_ptr<gpu::Device> device() {
  static const std::shared_ptr<gpu::Device> shared = gpu::Device::open().value();
  return shared;
}

constexpr glm::dvec3 k_to_light{0.6, 0.8, 0};
constexpr double k_alpha = 0.4;

std::uint64_t words_of(const std::string& method, const registry::ParameterValues& values) {
  const std::string layers = method == "deep_opacity" ? "layers" : method == "opacity_map" ? "slices" : "";
  const std::uint64_t numbers = layers.empty() ? 7 : std::uint64_t(values.integer(layers)),
                      side = std::uint64_t(values.integer("resolution"));
  return numbers * side * side;
}

/// The largest difference of T at the vertices between the device and the CPU.
double difference(const std::string& method, const std::string& set) {
  const strands::Groom groom = tests::coat(300, 8, 0.03, 1e-4f, 5);
  const tests::VertexReceivers receivers = tests::vertex_receivers(groom);
  const auto values = tests::values_of(method, set).value();
  EXPECT_GT(4 * words_of(method, values), device()->info().max_storage_buffer_bytes) << "one buffer holds it";
  const auto shadow = (*find_gpu_method(method))->create(device(), values);
  EXPECT_TRUE(shadow) << (shadow ? "" : shadow.error().message);
  if (!shadow) return 1;
  const auto on_device = upload_groom(*device(), groom).value();
  gpu::Commands commands = device()->record();
  EXPECT_TRUE((*shadow)->record(commands, on_device->strands, k_alpha, {k_to_light}, on_device->transmittance));
  EXPECT_TRUE(device()->submit(std::move(commands)));
  const auto found = gpu::read_buffer<float>(*device(), on_device->transmittance, groom.vertex_count()).value();
  const auto twin =
      (*find_method(method))->evaluate({&groom, k_alpha, k_to_light}, receivers.of(groom), values).value();
  double largest = 0;
  for (std::size_t v = 0; v < found.size(); ++v)
    largest = std::max(largest, std::abs(double(found[v]) - double(twin.values[v])));
  return largest;
}

}  // namespace

TEST(MapStrips, LargerThanABuffer_AgreeWithTheCpu) {
  for (const auto& [method, set] : {std::pair<std::string, std::string>{"deep_opacity", "layers=16,resolution=2048"},
                                    {"deep_opacity", "layers=16,resolution=2048,storage=bytes,filter_texels=3"},
                                    {"deep_opacity", "layers=12,resolution=2048,tiles=sparse,tile_share=0.5"},
                                    {"opacity_map", "slices=20,resolution=2048,filter_texels=2"},
                                    {"fourier", "harmonics=3,resolution=2304"}}) {
    const double largest = difference(method, set);
    std::printf("%s %s: %.2g\n", method.c_str(), set.c_str(), largest);
    EXPECT_LT(largest, 2e-5) << method << " " << set;
  }
}

}  // namespace cuticle::shadows::map_strips_gpu_test
