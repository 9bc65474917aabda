// The tiles' lists, where they outgrow the room that they have or may have.
#include <gtest/gtest.h>

#include "tests/support/tile_passes.h"

namespace cuticle::render::tiles_budget_gpu_test {
namespace {

using tests::bundle, tests::draw, tests::Drawing, tests::Drawn, tests::mean_difference, tests::Tiles;

TEST(TilesBudget, ListsThatGrow_LeaveTheSamePicture) {
  Drawing drawing = bundle(100);
  for (glm::vec4& vertex : drawing.vertices) vertex.w = 8 * drawing.pixel();
  Tiles tiles(drawing);
  const Drawn first = tiles.draw(), second = tiles.draw();
  EXPECT_GT(first.attempts, 1) << "the first guess was enough: the test does not reach what it is for";
  EXPECT_EQ(second.attempts, 1);
  EXPECT_EQ(first.color.pixels, second.color.pixels);
}

TEST(TilesBudget, TooSmall_DrawsFewerWiderStrandsAndSaysSo) {
  Drawing drawing = bundle(600);
  for (glm::vec4& vertex : drawing.vertices) vertex.w = 0.05f * drawing.pixel();  // thin: none hides another
  const Drawn whole = draw(drawing);
  drawing.budget_mib = 0.1;
  const Drawn thinned = draw(drawing);
  ASSERT_EQ(thinned.notes.size(), 1u);
  const Image none = make_image(drawing.size, drawing.size, {"R", "G", "B", "A"});
  EXPECT_NEAR(mean_difference(thinned.color, none, 3, 4) / mean_difference(whole.color, none, 3, 4), 1, 0.05);
}

// Rows of 64 segments, each a strand: as many as fit are there from end to end, not a part of each.
TEST(TilesBudget, TooSmall_LeavesStrandsWhole) {
  Drawing drawing;
  drawing.vertices_per_strand = 65;
  for (int row = 1; row < drawing.size; row += 3) {
    std::vector<glm::vec3> points;
    for (int k = 0; k <= 64; ++k)
      points.emplace_back(0.125f * float(k) - 4, drawing.pixel() * (float(row) + 0.5f) - 4, 0);
    drawing.strand(points, 0.1f * drawing.pixel(), glm::vec3(1, 0, 0));
  }
  drawing.budget_mib = 0.01;
  const Drawn drawn = draw(drawing);
  ASSERT_EQ(drawn.notes.size(), 1u);
  int there = 0, gone = 0;
  for (int y = 0; y < drawing.size; ++y) {
    int covered = 0;
    for (int x = 1; x + 1 < drawing.size; ++x) covered += drawn.alpha(x, y) > 0.05f ? 1 : 0;
    EXPECT_TRUE(covered == 0 || covered == drawing.size - 2) << "row " << y << ": " << covered;
    (covered == 0 ? gone : there) += 1;
  }
  EXPECT_GT(there, 3);
  EXPECT_GT(gone, drawing.size * 2 / 3 + 3) << "some strands are left out";
}

}  // namespace
}  // namespace cuticle::render::tiles_budget_gpu_test
