// F10: prefix by coverage, widths that keep the area, fewer vertices; error against the full groom.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "strands/lod/lod.h"
#include "strands/lod/spread_order.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::strands::lod_test {
namespace {

const Groom& coat_as_it_grew() {
  static const Groom groom = tests::coat(4000, 32, 0.05, 4e-5f, 3);
  return groom;
}

/// Its strands stand in spread order.
const Groom& coat() {
  static const Groom groom = selected(coat_as_it_grew(), spread_order(shapes_of(coat_as_it_grew())));
  return groom;
}

Groom coat_by_chance(std::uint32_t seed) {
  std::vector<std::uint32_t> order(coat_as_it_grew().strand_count());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  return selected(coat_as_it_grew(), order);
}

TEST(Selected, Strands_KeepsAllThatBelongsToAStrand) {
  Groom groom;
  tests::add_strand(groom, {{0, 0, 0}, {0, 1, 0}}, 1);
  tests::add_strand(groom, {{5, 0, 0}, {5, 1, 0}, {5, 2, 0}}, 2);
  groom.root_uv = {{0, 0}, {1, 1}};
  groom.attributes["tint"] = {Attribute::Domain::vertex, 1, {1, 2, 3, 4, 5}};
  groom.attributes["kind"] = {Attribute::Domain::strand, 1, {8, 9}};
  const Groom one = selected(groom, {1});
  ASSERT_TRUE(validate(one).ok());
  EXPECT_EQ(one.positions[2], glm::vec3(5, 2, 0));
  EXPECT_EQ(one.root_uv[0], glm::vec2(1, 1));
  EXPECT_EQ(one.attributes.at("tint").values, (std::vector<float>{3, 4, 5}));
  EXPECT_EQ(one.attributes.at("kind").values, (std::vector<float>{9}));
}

TEST(Level, FullCoverage_IsTheGroomItself) {
  const LevelOfDetail level = level_of_detail(coat(), 1e5, 9e4);
  EXPECT_EQ(level.strands, 4000u);
  EXPECT_EQ(level.vertices, 32u);
  EXPECT_EQ(level.width, 1);
  EXPECT_EQ(at_level(coat(), level), coat());
}

TEST(Level, QuarterOfThePixels_QuarterOfTheStrandsHalfTheVertices) {
  const LevelOfDetail level = level_of_detail(coat(), 25000, 1e5);
  EXPECT_EQ(level.strands, 1000u);
  EXPECT_EQ(level.vertices, 16u);
  EXPECT_NEAR(level.width, 4, 0.2);
}

TEST(Level, FarOff_KeepsTheLeast_AndEmptyGroomsAreFine) {
  EXPECT_EQ(level_of_detail(coat(), 0, 1e5).strands, 40u);
  EXPECT_EQ(level_of_detail(coat(), 0, 1e5, 1e-9).strands, 1u);
  EXPECT_EQ(level_of_detail(Groom(), 10, 1e5).strands, 0u);
}

TEST(Level, Width_ConservesTheArea) {
  for (double pixels : {5e4, 1e4, 2e3}) {
    LevelOfDetail level = level_of_detail(coat(), pixels, 1e5);
    level.vertices = 32;
    EXPECT_LT(level_error(coat(), at_level(coat(), level), 32).area, 2e-6) << pixels;
    // Chords of fewer vertices are shorter.
    EXPECT_LT(level_error(coat(), at_level(coat(), level_of_detail(coat(), pixels, 1e5)), 32).area, 2e-3) << pixels;
  }
}

double error_of_cells(const Groom& groom, double share) {
  return level_error(groom, at_level(groom, level_of_detail(groom, share, 1)), 24).cells;
}

/// Mean of eight orders; from order to order it differs by 5 % (one sigma).
double error_by_chance(double share) {
  double sum = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) sum += error_of_cells(coat_by_chance(seed), share);
  return sum / 8;
}

TEST(Level, ErrorByChance_FallsAsTheRootOfTheStrandsAndIsZeroInFull) {
  EXPECT_LT(level_error(coat(), coat(), 24).cells, 1e-12);
  // Of N strands n are drawn: the error of a fair sample goes as sqrt(N / n - 1).
  const double half = error_by_chance(0.5), sixteenth = error_by_chance(1.0 / 16);
  EXPECT_NEAR(sixteenth / half, std::sqrt(15.0), 0.8);
}

TEST(Level, ErrorInSpreadOrder_IsBelowThatByChance) {
  for (double share : {0.5, 0.25, 1.0 / 16}) {
    const double spread = error_of_cells(coat(), share), chance = error_by_chance(share);
    std::printf("difference of cells, %g of the strands: %.3f, by chance %.3f\n", share, spread, chance);
    EXPECT_LT(spread, 0.82 * chance);  // .65, .69 and .81
  }
}

TEST(Coverage, OfABoxSeenFromAfar_FallsWithTheSquareOfTheDistance) {
  const Bounds box{{-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}};
  Camera camera;
  camera.position = {0, 0, 10};
  const double near = covered_pixels(box, camera);
  camera.position.z = 20;
  EXPECT_NEAR(near / covered_pixels(box, camera), 4, 0.1);
  camera.position.z = 0.05;
  EXPECT_EQ(covered_pixels(box, camera), 640.0 * 640);
}

}  // namespace
}  // namespace cuticle::strands::lod_test
