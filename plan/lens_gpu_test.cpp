// A lens of finite width against what it stands for: the mean of pictures from all over the lens.
#include "plan/frame_runner_gpu.h"

#include <cmath>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "core/shared/disc.glslh"
#include "gpu/tests/test_device.h"

namespace cuticle::plan::lens_gpu_test {
namespace {

constexpr std::uint32_t k_views = 16;
constexpr double k_lens = 0.03, k_focus = 0.95;  // metres

using tests::device;

const glm::dvec3 k_eye{0.2, 0.15, 1.1}, k_target{0, 0.05, 0};

/// From a place of the lens, in units of its radius; sharp at k_focus from its middle.
scene::Scene scene_from(const char* method, glm::dvec2 on_lens, const std::string& passes = "") {
  const glm::dvec3 forward = glm::normalize(k_target - k_eye), right = glm::normalize(glm::cross(forward, {0, 1, 0}));
  const glm::dvec3 eye = k_eye + k_lens * (on_lens.x * right + on_lens.y * glm::cross(right, forward));
  const glm::dvec3 sharp = k_eye + k_focus * forward;
  const std::string text = fmt::format(
      R"({{"schema_version": 1, "strand_count": 1500, "strand_vertices": 12, "material": {{"lut_size": 16}},
      "lights": [{{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}}], "render": {{"method": "{}"}}, "camera":
      {{"position_m": [{},{},{}], "target_m": [{},{},{}], "fov_deg": 26, "resolution_px": [128, 128]}}{}}})",
      method, eye.x, eye.y, eye.z, sharp.x, sharp.y, sharp.z, passes);
  const auto scene = scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  return *scene;
}

Image picture(FrameRunner& runner, const scene::Scene& scene) {
  EXPECT_TRUE(runner.change(scene, silent_progress()));
  const auto result = runner.run(0, {.render = true});
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  for (const gpu::PassCost& pass : result->cost.passes) {
    const PlannedPass* const planned = find_pass(runner.plan(), pass.name);
    EXPECT_TRUE(planned && planned->dispatches == pass.dispatches) << pass.name;
  }
  return result->color;
}

Image mean_over_lens(FrameRunner& runner, const char* method) {
  Image mean;
  for (std::uint32_t k = 0; k < k_views; ++k) {
    const Image view = picture(runner, scene_from(method, disc_point(k, k_views, 0.0)));
    if (k == 0) mean = make_image(view.width, view.height, view.channel_names);
    for (std::size_t p = 0; p < view.pixels.size(); ++p) mean.pixels[p] += view.pixels[p] / k_views;
  }
  return mean;
}

double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p) sum += std::abs(double(a.pixels[p] - b.pixels[p]));
  return sum / double(a.pixels.size());
}

class Lens : public testing::TestWithParam<const char*> {};
TEST_P(Lens, DepthOfField_ComesNearTheMeanOverTheLens) {
  const std::string passes =
      fmt::format(R"(, "passes": {{"depth_of_field": {{"lens_radius": {}, "focus": {}}}}})", 1e3 * k_lens, k_focus);
  const scene::Scene pinhole = scene_from(GetParam(), {0, 0});
  const auto runner = *FrameRunner::create(device(), pinhole, silent_progress());
  const Image truth = mean_over_lens(*runner, GetParam());
  const double without = difference(picture(*runner, pinhole), truth),
               with = difference(picture(*runner, scene_from(GetParam(), {0, 0}, passes)), truth);
  RecordProperty("pinhole", std::to_string(without));
  RecordProperty("lens", std::to_string(with));
  EXPECT_LT(with, 0.45 * without);
}
INSTANTIATE_TEST_SUITE_P(Methods, Lens, testing::Values("tiles", "quads"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace cuticle::plan::lens_gpu_test
