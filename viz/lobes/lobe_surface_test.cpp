// The numbers behind a view of lobes and of strands.
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "viz/lobe_surface.h"
#include "viz/strand_lines.h"

namespace cuticle::viz::lobe_surface_test {
namespace {

LobesView view_of(int lobe, bool logarithmic) {
  const bsdf::Model* model = bsdf::find_model("marschner").value();
  return {model, registry::default_values(model->entry.parameters), 0.5, lobe, logarithmic};
}

TEST(SurfaceRadius, Decades_AreEvenSteps) {
  EXPECT_DOUBLE_EQ(surface_radius(10, 10, true), 1);
  EXPECT_DOUBLE_EQ(surface_radius(1, 10, true), 2.0 / 3);
  EXPECT_DOUBLE_EQ(surface_radius(1e-9, 10, true), 0);
  EXPECT_DOUBLE_EQ(surface_radius(0, 10, true), 0);
  EXPECT_DOUBLE_EQ(surface_radius(1e9, 10, true), 1);
}

TEST(SurfaceRadius, Linear_IsTheShareOfThePeak) { EXPECT_DOUBLE_EQ(surface_radius(2.5, 10, false), 0.25); }

TEST(MakeSurfaces, SingleLobe_ReachesAsFarAsTheModelSays) {
  const LobesView view = view_of(1, false);
  const LobeSurfaces set = make_surfaces(view).value();
  ASSERT_EQ(set.surfaces.size(), 1u);
  EXPECT_EQ(set.surfaces[0].name, "TT");
  const int row = 47, column = 350;
  const bsdf::Point point{.theta_i = 0.5, .theta_o = set.grid.theta_o(row), .phi = set.grid.phi(column)};
  glm::dvec3 value;
  ASSERT_TRUE(bsdf::evaluate(*view.model, view.values, bsdf::Precision::f64,
                             {bsdf::Quantity::S, 1, std::span(&point, 1)}, std::span(&value, 1))
                  .ok());
  const glm::dvec3 position = set.surfaces[0].positions[std::size_t(row) * set.grid.columns + column];
  const double radius = std::sqrt(position.x * position.x + position.y * position.y + position.z * position.z);
  EXPECT_NEAR(radius * set.peak, (value.x + value.y + value.z) / 3, 1e-3 * set.peak);
  EXPECT_NEAR(std::atan2(position.y, position.x), point.phi, 1e-9);
  EXPECT_NEAR(std::asin(position.z / radius), point.theta_o, 1e-9);
}

TEST(MakeSurfaces, AllLobes_AreOneSurfaceEachInItsColour) {
  const LobeSurfaces set = make_surfaces(view_of(LobesView::k_all_lobes, true)).value();
  ASSERT_EQ(set.surfaces.size(), 3u);
  const char* const names[] = {"R", "TT", "TRT"};
  for (std::size_t lobe = 0; lobe < 3; ++lobe) EXPECT_EQ(set.surfaces[lobe].colors.front(), lobe_color(names[lobe]));
}

TEST(ArcLengths, EachStrand_StartsAtItsRoot) {
  strands::Groom groom;
  groom.offsets = {0, 3, 5};
  groom.positions = {{0, 0, 0}, {0, 3, 4}, {0, 3, 5}, {1, 0, 0}, {3, 0, 0}};
  groom.radii.assign(5, 1e-5F);
  EXPECT_THAT(arc_lengths(groom), testing::ElementsAre(0, 5, 6, 0, 2));
}

TEST(Show, NoDisplay_IsAnErrorThatNamesXvfbRun) {
  unsetenv("DISPLAY");
  const auto result = show(view_of(0, true), {"/nonexistent/never.png", {100, 100}});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::no_device);
  EXPECT_THAT(result.error().hint, testing::HasSubstr("xvfb-run"));
}

TEST(Show, DisplayThatDoesNotAnswer_IsAnErrorToo) {
  setenv("DISPLAY", ":7654", 1);
  const auto result = show(view_of(0, true), {"/nonexistent/never.png", {100, 100}});
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, testing::HasSubstr(":7654"));
}

TEST(LoadStrands, MissingState_NamesTheFile) {
  for (const char* path : {"/nonexistent/state.vtp", "/nonexistent/groom.hair"}) {
    const auto result = load_strands(path, 0);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(result.error().message, testing::HasSubstr(path));
  }
}

}  // namespace
}  // namespace cuticle::viz::lobe_surface_test
