// Strands that are not seen are not drawn, and nobody can tell from the picture.
#include "tests/support/small_frames.h"

#include <cstdio>

#include <fmt/core.h>
#include <gmock/gmock.h>

namespace cuticle::plan::culling_gpu_test {
namespace {

using namespace tests;

constexpr std::string_view
    k_all = R"("passes": {"cull_strands": {"wanted": false}})",
    k_close = R"("camera": {"position_m": [0.05, 0.1, 0.35], "target_m": [0.05, 0.1, 0], "fov_deg": 20,
                 "resolution_px": [96, 64]})",
    k_inside = R"("camera": {"position_m": [0.02, 0.14, 0.1], "target_m": [0, 0.1, 0], "fov_deg": 60,
                  "resolution_px": [64, 64]})",
    k_behind_floor = R"("floor": {"height_m": 0.12}, "camera": {"position_m": [0.2, 0.5, 0.6], "target_m": [0, 0.05, 0],
                        "fov_deg": 30, "resolution_px": [64, 64]})",
    k_fine = R"("camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 30,
                "resolution_px": [256, 256]})",
    k_bald = R"("head": {"present": false})", k_layers = R"("outputs": {"aovs": true})";

/// Strands that the frame drew, of 500.
int drawn(const FrameResult& frame) {
  int count = 500, all = 500;
  for (const std::string& note : frame.notes) std::sscanf(note.c_str(), "cull_strands: %d of %d", &count, &all);
  EXPECT_EQ(all, 500);
  return count;
}

class Culling : public testing::TestWithParam<std::string_view> {};

TEST_P(Culling, OfAnyView_LeavesThePictureBitByBit) {
  for (std::string_view view : {k_fine, k_close, k_inside, k_behind_floor, k_bald}) {
    const FrameResult culled = frame_of(*runner({k_light, k_shadow, GetParam(), k_layers, view}), 1),
                      whole = frame_of(*runner({k_light, k_shadow, GetParam(), k_layers, view, k_all}), 1);
    EXPECT_EQ(culled.color.pixels, whole.color.pixels) << view;
    EXPECT_EQ(culled.aovs.pixels, whole.aovs.pixels) << view;
    EXPECT_EQ(drawn(whole), 500);
  }
}

TEST_P(Culling, HeadSeenFromClose_DrawsFewerStrands) {
  const auto drawn_in = [&](std::string_view view) { return drawn(frame_of(*runner({k_light, GetParam(), view}), 0)); };
  const int whole = drawn_in(k_fine), close = drawn_in(k_close), bald = drawn_in(k_bald),
            below = drawn_in(k_behind_floor);
  std::printf("of 500 strands: %d without a head, %d around it, %d from close, %d above a floor\n", bald, whole, close,
              below);
  EXPECT_EQ(bald, 500);
  EXPECT_LT(whole, 500);
  EXPECT_LT(below, 470);  // measured: 454 by quads, 386 by lines
  EXPECT_LT(close, 0.5 * whole);
  EXPECT_GT(close, 0);
}
INSTANTIATE_TEST_SUITE_P(Methods, Culling, testing::Values(k_quads, k_lines),
                         [](const auto& tested) { return tested.param == k_quads ? "quads" : "lines"; });

constexpr std::string_view k_deep = R"("shadow": {"method": {"deep_opacity": {"resolution": 64}}, "fibre_alpha": 0.4})",
                           k_half = R"("camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0.14, 0.05, 0],
                             "fov_deg": 12, "resolution_px": [64, 64]})",
                           k_over_all = R"("passes": {"velocity": {}, "surface_shadow": {"resolution": 128},
                             "strands_in_sight": {"wanted": false}})",
                           k_over_sight = R"("passes": {"velocity": {}, "surface_shadow": {"resolution": 128}})";

/// Strands that the frame shaded, of 500.
int shaded(const FrameResult& frame) {
  int count = 500, all = 500;
  for (const std::string& note : frame.notes) std::sscanf(note.c_str(), "strands_in_sight: %d of %d", &count, &all);
  EXPECT_EQ(all, 500);
  return count;
}

/// Two moving frames, whose hair is half out of the camera's view, as they are where every strand is shaded.
class Sight : public testing::TestWithParam<std::string_view> {};

TEST_P(Sight, HalfTheHairOutOfView_IsNeitherShadedNorSorted) {
  for (std::string_view shadow : {k_shadow, k_deep})
    for (std::string_view view : {k_half}) {
      const auto sparing = runner({k_light, shadow, GetParam(), k_layers, k_motion, view, k_over_sight}),
                 all = runner({k_light, shadow, GetParam(), k_layers, k_motion, view, k_over_all});
      for (int frame = 0; frame < 2; ++frame) {
        const FrameResult a = frame_of(*sparing, frame), b = frame_of(*all, frame);
        EXPECT_TRUE(a.color.pixels == b.color.pixels) << view << shadow << frame;
        EXPECT_TRUE(a.aovs.pixels == b.aovs.pixels) << view << shadow << frame;
        EXPECT_EQ(shaded(b), 500);
        EXPECT_LT(shaded(a), 360) << view;  // measured: 339
        EXPECT_GT(shaded(a), 100) << view;
      }
    }
}
INSTANTIATE_TEST_SUITE_P(Methods, Sight, testing::Values(k_quads, k_lines, k_tiles), [](const auto& tested) {
  return tested.param == k_quads ? "quads" : tested.param == k_lines ? "lines" : "tiles";
});

// A level of detail looks shadows up for the strands that it draws alone.
TEST(Sight, OfALevelOfDetail_LooksAtTheStrandsThatAreDrawn) {
  constexpr std::string_view level = R"("passes": {"tile_lists": {"full_px": 10000}})";
  const FrameResult frame = frame_of(*runner({k_light, k_shadow, k_tiles, k_half, level}), 0);
  int count = 0, all = 0;
  for (const std::string& note : frame.notes) std::sscanf(note.c_str(), "strands_in_sight: %d of %d", &count, &all);
  EXPECT_EQ(all, 74);  // 500 / 2^(11/4): the hair covers between a seventh and an eighth of so many pixels
  EXPECT_LT(count, all);
}

}  // namespace
}  // namespace cuticle::plan::culling_gpu_test
