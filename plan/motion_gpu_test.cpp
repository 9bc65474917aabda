// Motion blur against the mean of pictures from all over the shutter;
// antialiasing over frames against more samples.
#include "gpu/tests/test_device.h"
#include "plan/frame_runner_gpu.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace cuticle::plan::motion_gpu_test {
namespace {

constexpr double k_turn = 5;                // degrees a frame
constexpr int k_moments = 8, k_size = 192;  // of an open shutter; pixels of its picture

using tests::device;

struct Setting {
  std::string method = "tiles";
  std::string passes = "";  ///< as in a scene file
  double turn = 0;          ///< degrees a frame
  int size = 96;            ///< of the picture, pixels
};

std::unique_ptr<FrameRunner> runner_of(const Setting& setting) {
  const std::string text = fmt::format(
      R"({{"schema_version": 1, "strand_count": 1500, "strand_vertices": 12, "material": {{"lut_size": 16}},
      "lights": [{{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}}], "render": {{"method": "{}"}}, "camera":
      {{"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 26, "turntable_deg_per_frame": {},
      "resolution_px": [{}, {}]}}, "passes": {{{}}}}})",
      setting.method, setting.turn, setting.size, setting.size, setting.passes);
  const auto scene = scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  auto runner = FrameRunner::create(device(), *scene, silent_progress());
  EXPECT_TRUE(runner) << (runner ? "" : runner.error().message);
  return std::move(*runner);
}

Image frame_of(FrameRunner& runner, int frame) {
  auto result = runner.run(frame);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return std::move(result->color);
}

double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p) sum += std::abs(double(a.pixels[p] - b.pixels[p]));
  return sum / double(a.pixels.size());
}

/// Blocks of `side` x `side` pixels averaged.
Image shrunk(const Image& image, int side) {
  Image small = make_image(image.width / side, image.height / side, image.channel_names);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 4; ++c)
        small.pixels[std::size_t(4 * (y / side * small.width + x / side) + c)] +=
            image.pixels[std::size_t(4 * (y * image.width + x) + c)] / float(side * side);
  return small;
}

class Motion : public testing::TestWithParam<const char*> {};

// The camera goes on as it went since the frame before; a frame's shutter opens before and closes after its time.
TEST_P(Motion, MotionBlur_ComesNearTheMeanOverTheShutter) {
  const std::string method = GetParam();
  const auto fine = runner_of({.method = method, .turn = k_turn / k_moments, .size = k_size});
  Image truth;
  for (int k = 0; k < k_moments; ++k) {
    const Image moment = frame_of(*fine, 3 * k_moments + k - k_moments / 2);
    if (k == 0) truth = make_image(moment.width, moment.height, moment.channel_names);
    for (std::size_t p = 0; p < moment.pixels.size(); ++p) truth.pixels[p] += moment.pixels[p] / k_moments;
  }
  const std::string blur = R"("motion_blur": {"shutter": 1})";
  const double without = difference(frame_of(*runner_of({.method = method, .turn = k_turn, .size = k_size}), 3), truth),
               with = difference(
                   frame_of(*runner_of({.method = method, .passes = blur, .turn = k_turn, .size = k_size}), 3), truth);
  std::printf("%s: %.5f, blurred %.5f: %.3f\n", GetParam(), without, with, with / without);
  EXPECT_LT(with, 0.77 * without);  // measured: at most .753, of quads
}

TEST_P(Motion, NothingMoves_ThePictureStays) {
  const Image sharp = frame_of(*runner_of({.method = GetParam()}), 1);
  EXPECT_EQ(frame_of(*runner_of({.method = GetParam(), .passes = R"("motion_blur": {})", .turn = 1e-12}), 1).pixels,
            sharp.pixels);
}

// Tiles find the depth of hair in the layers, which the file then has only where they were asked for.
TEST_P(Motion, WhatPassesReadOfThePicture_IsNotAmongItsLayers) {
  const auto blurred = runner_of({.method = GetParam(), .passes = R"("motion_blur": {})", .turn = 1})->run(0),
             wanted = runner_of({.method = GetParam(), .passes = R"("motion_blur": {}, "velocity": {})"})->run(0);
  ASSERT_TRUE(blurred && wanted);
  EXPECT_TRUE(blurred->aovs.pixels.empty());
  EXPECT_FALSE(wanted->aovs.pixels.empty());
}
INSTANTIATE_TEST_SUITE_P(Methods, Motion, testing::Values("tiles", "quads", "lines"),
                         [](const auto& tested) { return std::string(tested.param); });

// Against the same picture with 16 times as many samples.
TEST(Antialiasing, WhereNothingMoves_ComesNearerFrameByFrame) {
  constexpr int k_finer = 4;
  const Image truth = shrunk(frame_of(*runner_of({.method = "quads", .size = 96 * k_finer}), 0), k_finer);
  const auto runner = runner_of({.method = "quads", .passes = R"("temporal_antialiasing": {})"});
  std::vector<double> errors;
  for (int frame = 0; frame < 16; ++frame) errors.push_back(difference(frame_of(*runner, frame), truth));
  for (const int frame : {0, 1, 3, 7, 15}) std::printf("frame %d: %.5f\n", frame, errors[std::size_t(frame)]);
  EXPECT_LT(errors[3], 0.8 * errors[0]);
  EXPECT_LT(errors[15], 0.6 * errors[0]);
}

// What a pixel changes by from frame to frame beside the change of the truth, the same pan with more samples.
TEST(Antialiasing, OfASlowPan_CalmsIt) {
  constexpr int k_finer = 4;
  const double turn = 0.15;
  const auto fine = runner_of({.method = "quads", .turn = turn, .size = 96 * k_finer}),
             plain = runner_of({.method = "quads", .turn = turn}),
             calm = runner_of({.method = "quads", .passes = R"("temporal_antialiasing": {})", .turn = turn});
  double flicker[2] = {0, 0}, error[2] = {0, 0};
  Image before[3];
  for (int frame = 0; frame < 8; ++frame) {
    const Image now[3] = {shrunk(frame_of(*fine, frame), k_finer), frame_of(*plain, frame), frame_of(*calm, frame)};
    for (int k = 0; frame >= 5 && k < 2; ++k) {
      for (std::size_t p = 0; p < now[0].pixels.size(); ++p)
        flicker[k] += std::abs(double(now[k + 1].pixels[p] - before[k + 1].pixels[p]) -
                               double(now[0].pixels[p] - before[0].pixels[p]));
      error[k] += difference(now[k + 1], now[0]);
    }
    std::copy(std::begin(now), std::end(now), before);
  }
  std::printf("flicker %.3f of that without, error %.3f\n", flicker[1] / flicker[0], error[1] / error[0]);
  EXPECT_LT(flicker[1], 0.8 * flicker[0]);
}

TEST(Antialiasing, OverOneFrame_LeavesThePictureWhereItIs) {
  const auto runner = runner_of({.method = "quads", .passes = R"("temporal_antialiasing": {"frames": 1})"}),
             plain = runner_of({.method = "quads"});
  for (const int frame : {0, 1}) EXPECT_EQ(frame_of(*runner, frame).pixels, frame_of(*plain, frame).pixels);
}

TEST(Antialiasing, ACut_BeginsAnew) {
  const auto runner = runner_of({.method = "quads", .passes = R"("temporal_antialiasing": {})"});
  const Image first = frame_of(*runner, 0), second = frame_of(*runner, 1);
  EXPECT_NE(first.pixels, second.pixels);
  EXPECT_EQ(frame_of(*runner, 5).pixels, first.pixels);
}

}  // namespace
}  // namespace cuticle::plan::motion_gpu_test
