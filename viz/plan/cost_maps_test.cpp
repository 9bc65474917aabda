// What a picture cost, from the layers of its file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "viz/plan/plan.h"

namespace cuticle::viz::cost_maps_test {
namespace {

using Plan = tests::TemporaryFolder;

/// 4 x 2 pixels: a strand at the upper left, an empty pixel that was looked at beside it, nothing below.
Image picture() {
  Image image = make_image(4, 2, {"R", "G", "B", "coverage.Y", "strand.id", "samples.Y", "cost.Y"});
  for (const int x : {0, 1}) {
    image.at(x, 0, 3) = 0.5F;
    image.at(x, 0, 4) = 7;
    image.at(x, 0, 5) = 2;
    image.at(x, 0, 6) = x == 0 ? 10 : 30;
  }
  image.at(2, 0, 6) = 4;
  return image;
}

TEST_F(Plan, Layers_BecomeMapsFromTheBottomUp) {
  ASSERT_TRUE(write_exr(path("frame.exr"), picture(), ExrType::single).ok());
  const PlanMaps maps = read_plan({path("frame.exr"), 2}).value();
  EXPECT_THAT(maps.cost.values, testing::ElementsAre(0, 0, 0, 0, 10, 30, 4, 0));
  EXPECT_THAT(maps.strand_cost.values, testing::ElementsAre(0, 0, 0, 0, 20, 20, 0, 0));
  EXPECT_THAT(maps.tile_cost.values, testing::ElementsAre(10, 1));
  EXPECT_DOUBLE_EQ(maps.shaded, 0.25);
  EXPECT_DOUBLE_EQ(maps.culled, 0.125);
  EXPECT_DOUBLE_EQ(maps.skipped, 0.625);
}

TEST_F(Plan, PictureWithoutLayers_SaysHowToGetThem) {
  ASSERT_TRUE(write_exr(path("frame.exr"), make_image(4, 2, {"R", "G", "B"}), ExrType::single).ok());
  const auto maps = read_plan({path("frame.exr"), 2});
  ASSERT_FALSE(maps.ok());
  EXPECT_THAT(maps.error().message, testing::HasSubstr("cost.Y"));
  EXPECT_THAT(maps.error().hint, testing::HasSubstr("--aovs"));
}

}  // namespace
}  // namespace cuticle::viz::cost_maps_test
