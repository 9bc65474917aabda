// The numbers behind a view of strands, and its files.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "tests/support/temporary_folder.h"
#include "viz/strands/states.h"

namespace cuticle::viz::states_test {
namespace {

strands::Groom small_groom() {
  strands::Groom groom;
  groom.offsets = {0, 3, 5};
  groom.positions = {{0, 0, 0}, {0, 3, 4}, {0, 3, 5}, {1, 0, 0}, {3, 0, 0}};
  groom.radii.assign(5, 1e-5F);
  groom.attributes["velocity"] = {strands::Attribute::Domain::vertex, 3, {3, 4, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 2, 0}};
  groom.attributes["stretch"] = {strands::Attribute::Domain::vertex, 1, {1, 1.5F, 1, 1, 0.9F}};
  return groom;
}

std::vector<float> colored(const char* name) { return color_strands(small_groom(), {name}).value().values; }

TEST(ArcLengths, EachStrand_StartsAtItsRoot) {
  EXPECT_THAT(colored("arc_length"), testing::ElementsAre(0, 5, 6, 0, 2));
}

TEST(ColorStrands, Vectors_ShowTheirLength) {
  EXPECT_THAT(colored("velocity"), testing::ElementsAre(5, 1, 0, 0, 2));
  EXPECT_THAT(colored("speed"), testing::ElementsAre(5, 1, 0, 0, 2));
}

TEST(ColorStrands, Unnamed_IsStretchAboutOne) {
  const ColoredStrands shown = color_strands(small_groom(), {""}).value();
  EXPECT_TRUE(shown.diverging);
  EXPECT_EQ(scale_of(shown).lower, 0.5);
  EXPECT_EQ(scale_of(shown).upper, 1.5);
}

TEST(ColorStrands, UnknownName_ListsWhatIsThere) {
  const auto shown = color_strands(small_groom(), {"tension"});
  ASSERT_FALSE(shown.ok());
  EXPECT_THAT(shown.error().message, testing::AllOf(testing::HasSubstr("stretch"), testing::HasSubstr("twist")));
}

TEST(ColorStrands, Helix_HasItsTorsion) {
  strands::Groom helix;
  constexpr double radius = 0.01, rise = 0.004;  // per radian
  for (int k = 0; k < 200; ++k)
    helix.positions.emplace_back(radius * std::cos(0.05 * k), radius * std::sin(0.05 * k), rise * 0.05 * k);
  helix.offsets = {0, 200};
  helix.radii.assign(200, 1e-5F);
  const double torsion = rise / (radius * radius + rise * rise);
  EXPECT_NEAR(double(color_strands(helix, {"twist"}).value().values[100]), torsion, 0.02 * torsion);
}

TEST(ColorStrands, Asleep_IsWhatDidNotMove) {
  const strands::Groom now = small_groom();
  strands::Groom before = now;
  before.positions[4].y += 1e-6F;
  EXPECT_THAT(color_strands(now, {"asleep"}, &before).value().values, testing::ElementsAre(1, 1, 1, 0, 0));
}

TEST(ColorStrands, Contact_IsTheDistanceToASphere) {
  StrandColoring coloring{"contact"};
  coloring.colliders = {{{0, 0, 0}, 0.5}};
  EXPECT_FLOAT_EQ(color_strands(small_groom(), coloring).value().values[3], 500);
}

using FindRun = tests::TemporaryFolder;
TEST_F(FindRun, Series_HasItsTimesAndFiles) {
  const std::string series = R"(<VTKFile type="Collection"><Collection><DataSet timestep="0" file="state_0007.vtp"/>
<DataSet timestep="0.25" file="state_0008.vtp"/></Collection></VTKFile>)";
  ASSERT_TRUE(write_text_file(path("states.pvd"), series).ok());
  const viz::Run run = find_run(path("states.pvd")).value();
  ASSERT_EQ(run.frames.size(), 2u);
  EXPECT_EQ(run.frames[1].time, 0.25);
  EXPECT_EQ(frame_at(run, 8).value(), 1);
  EXPECT_THAT(frame_at(run, 9).error().message, testing::HasSubstr("7 .. 8"));
}

}  // namespace
}  // namespace cuticle::viz::states_test
