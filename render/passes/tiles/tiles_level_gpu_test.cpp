// Strands of a level of detail let light through, by samples.
#include <gtest/gtest.h>

#include "strands/lod/lod.h"
#include "tests/support/tile_passes.h"

namespace cuticle::render::tiles_level_gpu_test {
namespace {

using tests::Drawing;

constexpr glm::vec3 k_red(1, 0, 0), k_green(0, 1, 0);
/// Of 256 samples half by chance, of two strands one after the other: three standard deviations.
constexpr double k_chance = 0.1;

/// Eight bands of one pixel's width across the picture, of so many segments each, one behind the other: red, then
/// green. A level of detail draws two of them, four times as wide and as wide again as they let through.
Drawing bands(int segments) {
  Drawing drawing;
  drawing.vertices_per_strand = std::uint32_t(segments + 1);
  for (int k = 0; k < 8; ++k) {
    std::vector<glm::vec3> points;
    for (int v = 0; v <= segments; ++v) points.emplace_back(-3 + 6 * float(v) / float(segments), 0, -0.1f * float(k));
    drawing.strand(points, 0.5f * drawing.pixel(), k == 0 ? k_red : k_green);
  }
  drawing.full_px = 4 * strands::covered_pixels({{-4, -4, -1}, {4, 4, 1}}, drawing.camera());
  return drawing;
}

TEST(TilesLevel, TwoStrandsOneBehindTheOther_EachLetHalfThrough) {
  const tests::Drawn drawn = tests::draw(bands(1));
  for (int x = 12; x < 52; ++x)
    for (int y : {30, 31, 32, 33}) {
      EXPECT_NEAR(drawn.color.at(x, y, 0), 0.5, k_chance) << x << " " << y;
      EXPECT_NEAR(drawn.color.at(x, y, 1), 0.25, k_chance) << x << " " << y;
      EXPECT_NEAR(drawn.color.at(x, y, 3), 0.75, k_chance) << x << " " << y;
    }
  EXPECT_EQ(drawn.color.at(32, 20, 3), 0) << "beside the bands";
}

// A strand lets through the same samples in all of its segments, so that their joints are no dots.
TEST(TilesLevel, StrandOfManySegments_CoversWhatOneSegmentDoes) {
  const tests::Drawn one = tests::draw(bands(1)), many = tests::draw(bands(12));
  for (int x = 12; x < 52; ++x)
    for (int c : {0, 1, 3}) EXPECT_NEAR(many.color.at(x, 31, c), one.color.at(x, 31, c), 0.01) << x << " " << c;
}

// Where all strands are drawn none lets light through.
TEST(TilesLevel, AllStrands_AreOpaque) {
  Drawing drawing = bands(1);
  drawing.full_px /= 8;
  const tests::Drawn level = tests::draw(drawing);
  drawing.full_px = 0;
  EXPECT_EQ(level.color.pixels, tests::draw(drawing).color.pixels);
}

}  // namespace
}  // namespace cuticle::render::tiles_level_gpu_test
