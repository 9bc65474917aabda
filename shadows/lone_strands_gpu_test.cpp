// Strands far apart keep all of the light on the device too: lone_strands_test.cpp by kernels.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "shadows/groom_gpu.h"
#include "shadows/light_frame.h"
#include "tests/support/lone_strands.h"
#include "tests/support/shadow_runs.h"

namespace cuticle::shadows::lone_strands_gpu_test {

namespace {

using tests::device;

/// Mean T over the vertices.
double light_left(GroomOnDevice& on_device, const std::string& method, const std::string& set, double alpha,
                  const LightSource& light) {
  const auto shadow = (*find_gpu_method(method))->create(device(), tests::values_of(method, set).value()).value();
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(shadow->record(commands, on_device.strands, alpha, light, on_device.transmittance));
  EXPECT_TRUE(device()->submit(std::move(commands)));
  return tests::mean(
      gpu::read_buffer<float>(*device(), on_device.transmittance, on_device.strands.vertex_count).value());
}
double light_left(const std::string& method, const std::string& set, double alpha,
                  const LightSource& light = {{0, 1, 0}}) {
  static const std::unique_ptr<GroomOnDevice> on_device = upload_groom(*device(), tests::lone_strands().groom).value();
  return light_left(*on_device, method, set, alpha, light);
}

/// The strands, and their vertices once more, which no segment joins: points that know no strand.
std::unique_ptr<GroomOnDevice> with_free_points() {
  const strands::Groom groom = tests::lone_strands().groom;
  auto on_device = upload_groom(*device(), groom).value();
  std::vector<glm::vec4> packed;
  for (int copy = 0; copy < 2; ++copy)
    for (std::size_t v = 0; v < groom.vertex_count(); ++v) packed.emplace_back(groom.positions[v], groom.radii[v]);
  on_device->vertices = gpu::make_buffer_from<glm::vec4>(*device(), packed).value();
  on_device->transmittance = device()->make_buffer(4 * packed.size()).value();
  on_device->strands.vertex_count = std::uint32_t(packed.size());
  return on_device;
}

}  // namespace

TEST(LoneStrandsGpu, AnyMethodFilterAndOpacity_AreLit) {
  const struct {
    std::string method, set;
  } settings[] = {{"opacity_map", "slices=16"},
                  {"opacity_map", "slices=17,form=graphics_8bit"},
                  {"opacity_map", "form=graphics_half"},
                  {"deep_opacity", "layers=8"},
                  {"deep_opacity", "storage=bytes"},
                  {"deep_opacity", "tiles=sparse"},
                  {"exact_list", "room_mib=16"},
                  {"deep_shadow", "room_mib=16"},
                  {"moments", "basis=power_4"},
                  {"moments", "basis=trigonometric_4"},
                  {"fourier", "harmonics=3"},
                  {"shadow_map", "bias_mm=1"}};
  for (const auto& [method, set] : settings)
    for (const std::string map : {"resolution=256,filter_texels=2.5", "resolution=768"})
      for (const double alpha : {1.0, 0.4}) {
        const double left = light_left(method, set + "," + map, alpha);
        EXPECT_GT(left, 0.995) << method << " " << set << ", " << map << ", alpha " << alpha;
        EXPECT_LE(left, 1.0 + 1e-6) << method << " " << set << ", " << map << ", alpha " << alpha;
      }
}

// Every method as it is by default, printed as a table; fine maps take long on software Vulkan, so only with
// CUTICLE_SWEEPS.
TEST(LoneStrandsGpu, DefaultsAtEveryResolution_AreLit) {
  if (!std::getenv("CUTICLE_SWEEPS")) GTEST_SKIP() << "only with CUTICLE_SWEEPS";
  for (const std::string method :
       {"opacity_map", "deep_opacity", "moments", "fourier", "exact_list", "deep_shadow", "shadow_map", "voxel"})
    for (const double alpha : {1.0, 0.4}) {
      std::printf("%s, alpha %.1f:", method.c_str(), alpha);
      for (const int size : {256, 512, 1024, 2048, 4096}) {
        const std::string set = "resolution=" + std::to_string(method == "voxel" ? std::min(size, 256) : size);
        const double left = light_left(method, set, alpha);
        std::printf(" %.4f", left);
        EXPECT_GT(left, 0.995) << method << " " << set << ", alpha " << alpha;
      }
      std::printf("\n");
    }
}

TEST(LoneStrandsGpu, UnderAPointLight_AreLit) {
  const LightSource point_light{{0, 1, 0}, glm::dvec3(0.3, 0.4, 0.3)};
  for (const std::string method : {"opacity_map", "deep_opacity", "moments", "fourier", "exact_list", "deep_shadow"})
    EXPECT_GT(light_left(method, "resolution=256", 1, point_light), 0.995) << method;
}

// The kernels would shadow the strands by themselves, did they not take their fibre out: half of these vertices name no
// strand, so that the mean is that of 1 and what these keep.
TEST(LoneStrandsGpu, PointsThatNoSegmentJoins_AreShadowedByTheStrands) {
  const auto on_device = with_free_points();
  for (const std::string method : {"opacity_map", "deep_opacity", "moments", "fourier", "exact_list", "deep_shadow"}) {
    const double left = light_left(*on_device, method, "resolution=512", 1, {{0, 1, 0}});
    EXPECT_LT(left, 0.5 * (1 + 0.85)) << method;
    EXPECT_GT(left, 0.5) << method;
  }
}

TEST(LoneStrandsGpu, Volumes_AreLit) {
  for (const std::string set : {"resolution=48", "resolution=96,filter_radius_mm=4"})
    for (const double alpha : {1.0, 0.4}) EXPECT_GT(light_left("voxel", set, alpha), 0.995) << set << alpha;
}

}  // namespace cuticle::shadows::lone_strands_gpu_test
