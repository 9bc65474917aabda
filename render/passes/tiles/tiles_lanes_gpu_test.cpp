// Tiles drawn by 32 or 64 invocations, as on a GPU, beside those drawn by eight.
#include <algorithm>

#include <gtest/gtest.h>

#include "strands/lod/lod.h"
#include "tests/support/device_bound.h"
#include "tests/support/tile_passes.h"

namespace cuticle::render::tiles_lanes_gpu_test {
namespace {

using tests::bundle, tests::device, tests::draw, tests::Drawing, tests::Drawn, tests::mean_difference;

struct Apart {
  double most = 0, mean = 0, depth = 0;
};

Apart apart(const Drawn& a, const Drawn& b) {
  Apart found;
  found.mean = mean_difference(a.color, b.color, 0, 4);
  for (std::size_t k = 0; k < a.color.pixels.size(); ++k)
    found.most = std::max(found.most, double(std::abs(a.color.pixels[k] - b.color.pixels[k])));
  for (std::size_t k = 0; k < a.depth.size(); ++k)
    found.depth = std::max(found.depth, double(std::abs(a.depth[k] - b.depth[k])));
  return found;
}

/// What 32 and 64 invocations leave otherwise than eight.
Apart apart_by_lanes(Drawing drawing) {
  drawing.lanes = 8;
  const Drawn eight = draw(drawing);
  Apart most;
  for (std::int64_t lanes : {32, 64}) {
    drawing.lanes = lanes;
    const Apart now = apart(draw(drawing), eight);
    std::printf("%d invocations: largest difference %.3g, mean %.3g, depth %.3g\n", int(lanes), now.most, now.mean,
                now.depth);
    most = {std::max(most.most, now.most), std::max(most.mean, now.mean), std::max(most.depth, now.depth)};
  }
  return most;
}

/// Curved strands over the whole picture, more than a chunk of them in each tile.
Drawing dense() {
  Drawing drawing = bundle(4000);
  for (glm::vec4& vertex : drawing.vertices) vertex.w *= 0.3f;
  return drawing;
}

/// On software Vulkan colours have the same bits; depths go through sums in another order of instructions.
void expect_the_same(const Drawing& drawing) {
  const Apart found = apart_by_lanes(drawing);
  EXPECT_LE(found.most, tests::bound_for(*device(), 0, 0.02));
  EXPECT_LE(found.mean, tests::bound_for(*device(), 0, 1e-4));
  EXPECT_LE(found.depth, tests::bound_for(*device(), 2e-7, 1e-3));
}

TEST(TilesLanes, BySamples_LeaveTheSamePicture) {
  expect_the_same(dense());
  Drawing of_three_rows = bundle(300);
  of_three_rows.coverage_rows = 3;
  expect_the_same(of_three_rows);
}

TEST(TilesLanes, ByAreas_LeaveTheSamePicture) {
  Drawing drawing = bundle(300);
  drawing.opacity = 0.4;
  expect_the_same(drawing);
}

TEST(TilesLanes, OfALevelOfDetail_LeaveTheSamePicture) {
  Drawing drawing = bundle(4000);
  drawing.vertices_per_strand = 8;
  drawing.full_px = 4 * strands::covered_pixels({{-4, -4, -1}, {4, 4, 1}}, drawing.camera());
  expect_the_same(drawing);
}

TEST(TilesLanes, BySlices_LeaveTheSamePicture) {
  Drawing drawing = bundle(300);
  drawing.slices = 40;
  expect_the_same(drawing);
}

TEST(TilesLanes, CameraInsideTheHair_SeesTheSame) { expect_the_same(tests::around_the_camera()); }

TEST(TilesLanes, PicturesThatEndWithinATile_AreTheSame) {
  for (int size : {7, 13}) {
    Drawing drawing = bundle(200);
    drawing.size = size;
    expect_the_same(drawing);
  }
}

// Also where strands lie at one depth, so that a bin holds them all.
TEST(TilesLanes, ManyStrandsAtOneDepth_AreInTheSameOrder) {
  Drawing drawing;
  drawing.opacity = 0.3;
  for (int k = 0; k < 3000; ++k) {
    const float x = 0.9f * drawing.pixel() * (float(k % 61) / 61 - 0.5f);
    drawing.strand({{x, -0.5f, 0}, {x, 0.5f, 0}}, 0.001f * drawing.pixel(),
                   {float(k % 2), float(k % 3) / 2, float(k % 5) / 4});
  }
  expect_the_same(drawing);
}

}  // namespace
}  // namespace cuticle::render::tiles_lanes_gpu_test
