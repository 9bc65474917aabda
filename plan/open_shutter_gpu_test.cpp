// Pictures of paths while hair and camera move, against the mean of still ones from all over the shutter.
#include <cmath>
#include <cstdlib>
#include <functional>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "plan/frame_runner_gpu.h"
#include "plan/traced_scene_runner.h"
#include "render/passes/motion_blur/motion_blur.h"
#include "render/passes/reference/reference_entry.h"

namespace cuticle::plan::open_shutter_gpu_test {
namespace {

constexpr int k_moments = 8, k_frame = 12;

struct Setting {
  double turn = 0;           ///< of the camera, degrees a frame of 1/30 s
  double amplitude = 0;      ///< of the head's motion
  int finer = 1;             ///< frames in the time of one
  int samples = 64;          ///< paths a pixel
  bool moves = true;         ///< the head, by its motion's amplitude
  std::string shutter = "";  ///< frames of 1/30 s; empty: none is asked for
  bool head = false;
};

scene::Scene scene_of(const Setting& setting) {
  const std::string blur =
      setting.shutter.empty() ? "" : fmt::format(R"(, "motion_blur": {{"shutter": {}}})", setting.shutter);
  const std::string motion =
      setting.moves ? fmt::format(R"("motion": {{"bvh": "motion/head_turn.bvh", "joint": "Head", "amplitude": {}}},)",
                                  setting.amplitude)
                    : "";
  const std::string text = fmt::format(
      R"({{"schema_version": 1, "strand_count": {}, "strand_vertices": 12, "frames_per_second": {}, {}
      "head": {{"present": {}}},
      "material": {{"model": {{"kajiya_kay": {{}}}}}},
      "lights": [{{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}}], "render": {{"method": "reference"}}, "camera":
      {{"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 14, "turntable_deg_per_frame": {},
      "resolution_px": [64, 64]}}, "passes": {{"reference": {{"samples": {}, "bounces": 1}}{}}}}})",
      setting.head ? 4 : 400, 30 * setting.finer, motion, setting.head, setting.turn / setting.finer, setting.samples,
      blur);
  const auto scene = scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  return *scene;
}

/// A scene of a file in scenes/, without simulation.
scene::Scene scene_of_file(const std::string& name, const Setting& setting) {
  scene::Scene scene = scene::load_scene(CUTICLE_SOURCE_DIR "/scenes/" + name, catalogue()).value();
  scene.simulation = {};
  scene.frames_per_second *= setting.finer;
  scene.camera.camera.resolution = {64, 64};
  scene.render_method = "reference";
  registry::ParameterValues paths = registry::default_values(render::reference::entry().entry.parameters);
  paths.set("samples", std::int64_t(setting.samples));
  paths.set("bounces", std::int64_t(1));
  scene.passes.insert_or_assign("reference", paths);
  if (setting.shutter.empty()) return scene;
  registry::ParameterValues blur = registry::default_values(render::motion_blur::entry().entry.parameters);
  blur.set("shutter", std::stod(setting.shutter));
  scene.passes.insert_or_assign("motion_blur", blur);
  return scene;
}

scene::Scene fins_of(const Setting& setting) {
  scene::Scene scene = scene_of_file("nalu.json", setting);
  scene.strand_count = 4;
  scene.motion->amplitude = setting.amplitude;
  return scene;
}

scene::Scene fox_of(const Setting& setting) {
  scene::Scene scene = scene_of_file("fox.json", setting);
  scene.groom.specification->strands.share = 0.002;
  return scene;
}

using SceneOf = std::function<scene::Scene(const Setting&)>;

std::unique_ptr<FrameRunner> runner_of(const Setting& setting, const SceneOf& scene = scene_of) {
  return FrameRunner::create(tests::device(), scene(setting), silent_progress()).value();
}

Image on_device(FrameRunner& runner, int frame) { return runner.run(frame).value().color; }

Image on_cpu(const Setting& setting, int frame) {
  return TracedSceneRunner::create(scene_of(setting), silent_progress())
      .value()
      ->run(frame, silent_progress())
      .value()
      .color;
}

constexpr int k_green = 1, k_coverage = 3;

/// Root mean square over blocks of 4 x 4 pixels.
double difference(const Image& a, const Image& b, int channel = k_coverage) {
  constexpr int k_side = 4;
  double squares = 0;
  for (int y = 0; y < a.height; y += k_side)
    for (int x = 0; x < a.width; x += k_side) {
      double sum = 0;
      for (int p = 0; p < k_side * k_side; ++p)
        sum += double(a.at(x + p % k_side, y + p / k_side, channel)) -
               double(b.at(x + p % k_side, y + p / k_side, channel));
      squares += sum * sum / std::pow(k_side, 4);
    }
  return std::sqrt(squares * k_side * k_side / (a.width * a.height));
}

/// Of pictures at the middles of equal parts of a frame's time.
Image mean_over_shutter(Setting setting, const SceneOf& scene) {
  setting.finer = 2 * k_moments;
  const auto fine = runner_of(setting, scene);
  Image mean;
  for (int k = 0; k < k_moments; ++k) {
    const Image moment = on_device(*fine, 2 * k_moments * k_frame + 2 * k + 1 - k_moments);
    if (k == 0) mean = make_image(moment.width, moment.height, moment.channel_names);
    for (std::size_t p = 0; p < mean.pixels.size(); ++p) mean.pixels[p] += moment.pixels[p] / k_moments;
  }
  return mean;
}

/// `most`: of the difference of a still picture.
void expect_mean_over_shutter(Setting setting, double most, int channel = k_coverage, const SceneOf& scene = scene_of) {
  const Image wanted = mean_over_shutter(setting, scene);
  setting.samples *= k_moments;
  const double still = difference(on_device(*runner_of(setting, scene), k_frame), wanted, channel);
  setting.shutter = "1";
  const double open = difference(on_device(*runner_of(setting, scene), k_frame), wanted, channel);
  fmt::print("still {:.4f}, open {:.4f}\n", still, open);
  EXPECT_LT(open, most * still);
}

TEST(OpenShutter, CarriedHair_IsTheMeanOverItsTime) { expect_mean_over_shutter({.amplitude = 4}, 0.5); }

// A head that turns covers what it covered; its light moves.
TEST(OpenShutter, HeadThatTurns_IsTheMeanOverItsTime) {
  expect_mean_over_shutter({.amplitude = 4, .head = true}, 0.5, k_green);
}

TEST(OpenShutter, FinsThatTurn_AreTheMeanOverTheirTime) {
  expect_mean_over_shutter({.amplitude = 4}, 0.5, k_green, fins_of);
}

TEST(OpenShutter, CharacterThatRuns_IsTheMeanOverItsTime) {
  if (!std::getenv("CUTICLE_TEST_DATA")) GTEST_SKIP() << "CUTICLE_TEST_DATA";
  expect_mean_over_shutter({.samples = 256}, 0.5, k_green, fox_of);
}

TEST(OpenShutter, CameraThatTurns_IsTheMeanOverItsTime) { expect_mean_over_shutter({.turn = 8}, 0.5); }

TEST(OpenShutter, OnTheCpu_IsTheDevices) {
  const Setting setting{.turn = 8, .amplitude = 4, .shutter = "1", .head = true};
  EXPECT_LT(difference(on_cpu(setting, k_frame), on_device(*runner_of(setting), k_frame)), 0.002);
}

TEST(OpenShutter, FramesInTurn_AreThoseAskedForAlone) {
  const Setting setting{.turn = 8, .amplitude = 4, .samples = 8, .shutter = "1"};
  const auto runner = runner_of(setting);
  on_device(*runner, k_frame - 1);
  EXPECT_EQ(on_device(*runner, k_frame).pixels, on_device(*runner_of(setting), k_frame).pixels);
}

TEST(OpenShutter, ClosedOrInFrame0_IsThePictureWithout) {
  const Setting none{.turn = 8, .amplitude = 4, .samples = 8},
      closed{.turn = 8, .amplitude = 4, .samples = 8, .shutter = "0"},
      open{.turn = 8, .amplitude = 4, .samples = 8, .shutter = "1"};
  EXPECT_EQ(on_device(*runner_of(closed), k_frame).pixels, on_device(*runner_of(none), k_frame).pixels);
  EXPECT_EQ(on_device(*runner_of(open), 0).pixels, on_device(*runner_of(none), 0).pixels);
  EXPECT_EQ(on_cpu(open, 0).pixels, on_cpu(none, 0).pixels);
}

TEST(OpenShutter, NothingMoves_ThePictureStays) {
  EXPECT_EQ(on_device(*runner_of({.samples = 8, .moves = false, .shutter = "1"}), 1).pixels,
            on_device(*runner_of({.samples = 8, .moves = false}), 1).pixels);
}

}  // namespace
}  // namespace cuticle::plan::open_shutter_gpu_test
