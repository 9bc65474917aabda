// Hair that is lit from one side: how light the other side is, by cards and by tiles.
#include "tests/support/small_frames.h"

#include <cstdio>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::plan::card_light_gpu_test {
namespace {

using namespace tests;

constexpr std::string_view
    k_bald = R"("head": {"present": false})",
    k_side = R"("lights": [{"to_light": [1, 0.2, 0], "irradiance": [6, 6, 6]}])",
    k_from_behind = R"("lights": [{"to_light": [0.3, 0.3, -1], "irradiance": [6, 6, 6]}])",
    k_dual = R"("passes": {"dual_scattering": {}})", k_plain = R"("passes": {})",
    k_coloured =
        R"("shadow": {"method": {"opacity_map": {"resolution": 64}}, "fibre_alpha": [0.3, 0.4, 0.5]},
    "material": {"lut_size": 32, "model": {"marschner": {"sigma_a": [0.0139, 0.0418, 0.12]}}})";

/// Mean colour of the hair in the columns first to last, of the pixels' part that is hair.
glm::dvec3 mean_color(const Image& picture, int first, int last) {
  glm::dvec3 sum(0);
  double covered = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = first; x <= last; ++x) {
      for (int c = 0; c < 3; ++c) sum[c] += double(picture.at(x, y, c));
      covered += double(picture.at(x, y, 3));
    }
  return sum / covered;
}

double luminance(const glm::dvec3& color) { return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)); }

struct Sides {
  glm::dvec3 lit, shaded;
};
Sides sides(std::string_view way, std::string_view passes, std::string_view shadow = k_shadow) {
  const Image picture = frame_of(*runner({k_side, shadow, k_bald, way, passes}), 0).color;
  return {mean_color(picture, 36, 63), mean_color(picture, 0, 27)};
}

void print(const char* what, const Sides& by) {
  std::printf("%s: towards the light %.4f %.4f %.4f (%.4f), away %.4f %.4f %.4f (%.4f)\n", what, by.lit.r, by.lit.g,
              by.lit.b, luminance(by.lit), by.shaded.r, by.shaded.g, by.shaded.b, luminance(by.shaded));
}

// Cards are lit as strands are by what other hair scatters; their highlights are Scheuermann's, of the mean of a lock.
TEST(CardLight, WithDualScattering_IsThatByTiles) {
  const Sides tiles = sides(k_tiles, k_dual), cards = sides(k_cards, k_dual);
  print("tiles", tiles);
  print("cards", cards);
  EXPECT_NEAR(luminance(cards.lit) / luminance(tiles.lit), 1, 0.05);       // measured: .98
  EXPECT_NEAR(luminance(cards.shaded) / luminance(tiles.shaded), 1, 0.2);  // measured: 1.16
}

TEST(CardLight, WithAmbient_IsThatByTiles) {
  const Sides tiles = sides(k_tiles, k_plain), cards = sides(k_cards, k_plain);
  print("tiles", tiles);
  print("cards", cards);
  EXPECT_NEAR(luminance(cards.lit) / luminance(tiles.lit), 1, 0.03);       // measured: 1.006
  EXPECT_NEAR(luminance(cards.shaded) / luminance(tiles.shaded), 1, 0.1);  // measured: 1.08
}

double ratio(const glm::dvec3& a, const glm::dvec3& b, int channel) {
  return (a[channel] / a[0]) / (b[channel] / b[0]);
}

// Hue by pigment and by crossings that differ between channels.
TEST(CardLight, OfPigmentedHairInAColouredShadow_HasTheHueByTiles) {
  const Sides tiles = sides(k_tiles, k_dual, k_coloured), cards = sides(k_cards, k_dual, k_coloured);
  print("tiles", tiles);
  print("cards", cards);
  for (int c : {1, 2}) {
    EXPECT_NEAR(ratio(cards.lit, tiles.lit, c), 1, 0.05);
    EXPECT_NEAR(ratio(cards.shaded, tiles.shaded, c), 1, 0.05);
  }
}

/// Hair over a black forehead, the light behind the head: what the head's shadow leaves of its light.
double left_over_the_forehead(std::string_view way) {
  const auto light = [&](std::string_view surfaces) {
    const std::string passes = fmt::format(R"("passes": {{"head": {{"skin": 0, "scalp": 0}}{}}})", surfaces);
    const Image picture = frame_of(*runner({k_from_behind, k_shadow, way, passes}), 0).color;
    double sum = 0;
    for (int y = 13; y < 17; ++y)
      for (int x = 23; x < 30; ++x) sum += double(picture.at(x, y, 0));
    return sum;
  };
  return light(R"(, "surface_shadow": {})") / light("");
}

TEST(CardLight, BehindTheHead_IsTakenAwayAsByTiles) {
  const double tiles = left_over_the_forehead(k_tiles), cards = left_over_the_forehead(k_cards);
  std::printf("the head's shadow leaves %.4f by tiles, %.4f by cards\n", tiles, cards);
  EXPECT_NEAR(cards, tiles, 0.07);  // measured: .521 by cards, .463 by tiles (.520 before strands stopped to shadow
                                    // themselves; the cause is not known)
}

}  // namespace
}  // namespace cuticle::plan::card_light_gpu_test
