// Strands far apart keep all of the light on the device too: lone_strands_test.cpp by kernels.
#include <gtest/gtest.h>

#include "shadows/groom_gpu.h"
#include "shadows/light_frame.h"
#include "tests/support/lone_strands.h"
#include "tests/support/shadow_runs.h"

namespace cuticle::shadows::lone_strands_gpu_test {

namespace {

std::shared_ptr<gpu::Device> device() {
  static const std::shared_ptr<gpu::Device> shared = gpu::Device::open().value();
  return shared;
}

/// Mean T over the vertices.
double light_left(const std::string& method, const std::string& set, double alpha) {
  static const strands::Groom groom = tests::lone_strands().groom;
  static const std::unique_ptr<GroomOnDevice> on_device = upload_groom(*device(), groom).value();
  const auto shadow = (*find_gpu_method(method))->create(device(), tests::values_of(method, set).value()).value();
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(shadow->record(commands, on_device->strands, alpha, {{0, 1, 0}}, on_device->transmittance));
  EXPECT_TRUE(device()->submit(std::move(commands)));
  return tests::mean(gpu::read_buffer<float>(*device(), on_device->transmittance, groom.vertex_count()).value());
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

TEST(LoneStrandsGpu, Volumes_AreLit) {
  for (const std::string set : {"resolution=48", "resolution=96,filter_radius_mm=4"})
    for (const double alpha : {1.0, 0.4}) EXPECT_GT(light_left("voxel", set, alpha), 0.995) << set << alpha;
}

}  // namespace cuticle::shadows::lone_strands_gpu_test
