// Point lights in whole pictures, by every way of drawing.
#include "gpu/tests/test_device.h"
#include "plan/frame_runner_gpu.h"

#include <cmath>
#include <tuple>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::plan::point_light_gpu_test {
namespace {

using tests::device;

Image picture(const std::string& method, const std::string& light) {
  const std::string text = fmt::format(
      R"({{"schema_version": 1, "strand_count": 1200, "strand_vertices": 12, "material": {{"lut_size": 16}}, {},
      "shadow": {{"method": {{"deep_opacity": {{"resolution": 128}}}}, "fibre_alpha": 0.4}}, "passes": {{"surface_shadow": {{"resolution": 256}}}},
      "render": {{"method": "{}"}}, "camera": {{"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 26,
      "resolution_px": [96, 96]}}}})",
      light, method);
  const auto scene = scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  const auto runner = FrameRunner::create(device(), *scene, silent_progress());
  EXPECT_TRUE(runner) << (runner ? "" : runner.error().message);
  const auto result = (*runner)->run(0);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result->color;
}

double mean(const Image& image) {
  double sum = 0;
  for (std::size_t p = 0; p < image.pixels.size(); ++p) sum += p % 4 == 3 ? 0 : double(image.pixels[p]);
  return sum / double(image.pixels.size());
}
double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p) sum += std::abs(double(a.pixels[p] - b.pixels[p]));
  return sum / double(a.pixels.size());
}

class PointLights : public testing::TestWithParam<const char*> {};

TEST_P(PointLights, FarAway_LightAsADistantLight) {
  constexpr double k_distance = 200;
  const glm::dvec3 place = k_distance * glm::normalize(glm::dvec3(0.3, 0.6, 1));
  const Image distant = picture(GetParam(), R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}])");
  const Image point_light =
      picture(GetParam(), fmt::format(R"("point_lights": [{{"position_m": [{0}, {1}, {2}], "intensity": [{3}, {3},
      {3}]}}])",
                                      place.x, place.y, place.z, 6 * k_distance * k_distance));
  const double share = difference(distant, point_light) / mean(distant);
  std::printf("%s: %.5f of the mean\n", GetParam(), share);
  EXPECT_LT(share, 0.0043);  // measured: at most 0.00403, of tiles
}

// In the middle of the head's hair, at no distance from some of it, and brighter than halves hold.
TEST_P(PointLights, InsideTheHair_GiveAFinitePicture) {
  const Image image =
      picture(GetParam(), R"("point_lights": [{"position_m": [0, 0.1, 0.1], "intensity": [1e5, 1e5, 1e5]}])");
  for (const float value : image.pixels) ASSERT_TRUE(std::isfinite(value));
  EXPECT_GT(mean(image), 0);
}
INSTANTIATE_TEST_SUITE_P(Methods, PointLights, testing::Values("lines", "quads", "tiles", "cards", "supersampled"),
                         [](const auto& tested) { return std::string(tested.param); });

// A point light beside the head: what tiles make of it is as near the truth as by a distant light.
TEST(PointLight, BesideTheHair_TilesAgreeWithTheTruth) {
  const std::string near = R"("point_lights": [{"position_m": [0.25, 0.4, 0.3], "intensity": [1.5, 1.5, 1.5]}])",
                    far = R"("lights": [{"to_light": [0.25, 0.3, 0.3], "irradiance": [6, 6, 6]}])";
  double share[2];
  for (const bool is_near : {false, true}) {
    const Image truth = picture("supersampled", is_near ? near : far);
    share[is_near] = difference(picture("tiles", is_near ? near : far), truth) / mean(truth);
  }
  std::printf("tiles against the truth: %.4f of the mean by a distant light, %.4f by a point light\n", share[0],
              share[1]);
  EXPECT_LT(share[1], 1.3 * share[0]);
}

TEST(PointLight, SpotThatPointsAway_LightsNothing) {
  const std::string point_light =
      R"("point_lights": [{"position_m": [0, 1, 1], "intensity": [1, 1, 1], "spot": {"outer_deg": 40, "to_m": )";
  EXPECT_EQ(mean(picture("quads", point_light + "[0, 2, 2]}}]")), 0);
  EXPECT_GT(mean(picture("quads", point_light + "[0, 0, 0]}}]")), 0.002);
}

// Above the camera, and below it.
TEST(Floor, FromAboveAlone_IsSeen) {
  const std::string light = R"("lights": [{"to_light": [0.25, 0.3, 0.3], "irradiance": [6, 6, 6]}])";
  for (const auto& [height, row, is_seen] : {std::tuple("0.3", 2, false), {"-0.3", 93, true}}) {
    const Image with = picture("tiles", light + fmt::format(R"(, "floor": {{"height_m": {}, "size_m": 4}})", height));
    EXPECT_EQ(difference(with, picture("tiles", light)) > 0.01, is_seen);
    EXPECT_EQ(with.at(2, row, 3) > 0.5f, is_seen);
  }
}

}  // namespace
}  // namespace cuticle::plan::point_light_gpu_test
