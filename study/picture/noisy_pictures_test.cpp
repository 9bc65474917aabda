// Squares of differences between pictures with known noise.
#include "study/picture/noisy_pictures.h"
#include "study/picture/shown_picture.h"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace cuticle::study::noisy_pictures_test {
namespace {

Image flat(int size, float value) {
  Image image = make_image(size, size, {"R", "G", "B", "A"});
  for (std::size_t k = 0; k < image.pixels.size(); ++k) image.pixels[k] = k % 4 == 3 ? 1.0f : value;
  return image;
}

NoisyPicture noisy(int size, float value, float deviation, std::size_t batches, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, deviation);
  NoisyPicture picture;
  for (std::size_t k = 0; k < batches; ++k) {
    Image image = flat(size, value);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      if (i % 4 < 3) image.pixels[i] += normal(random);
    picture.batches.push_back(std::move(image));
  }
  return picture;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double standard_error(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += (value - mean(values)) * (value - mean(values));
  return std::sqrt(sum / double(values.size()) / double(values.size()));
}

// Noise three times as large as the difference: the plain square of the means would be nine times too large.
TEST(RelativeSquares, NoiseAboveTheDifference_IsLeftOut) {
  const NoisyPicture truth = noisy(128, 1, 0.6f, 4, 1), other = noisy(128, 1.2f, 0.6f, 4, 2);
  const RelativeSquares squares({&truth, &other});
  const std::vector<double> tiles = squares.tiles(truth, other);
  EXPECT_EQ(tiles.size(), 256u);
  EXPECT_NEAR(mean(tiles), 0.04 / 2, 4 * standard_error(tiles));
  EXPECT_LT(standard_error(tiles), 0.002);
  const std::vector<double> nothing = squares.tiles(truth, noisy(128, 1, 0.6f, 4, 3));
  EXPECT_NEAR(mean(nothing), 0, 4 * standard_error(nothing));
  EXPECT_GT(mean(RelativeSquares({&truth}).tiles({{mean_of(truth)}}, {{mean_of(other)}})), 4 * 0.02);
}

// Of 200 pairs of noisy pictures, one a fifth brighter, the interval holds the fifth in 95 %.
TEST(LightShares, Intervals_HoldTheShare) {
  int held = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const LightShare share = light_shares(noisy(8, 1.2f, 2, 8, 2 * seed), noisy(8, 1, 2, 8, 2 * seed + 1))[0];
    EXPECT_GT(share.half_width, 0.02);
    held += std::abs(share.share - 1.2) < share.half_width;
  }
  EXPECT_GE(held, 180);
  EXPECT_LT(held, 200);
  const NoisyPicture truth{{flat(8, 1)}}, other{{flat(8, 0.5f)}};
  EXPECT_EQ(light_shares(other, truth)[1].share, 0.5);
  EXPECT_EQ(light_shares(other, truth)[1].half_width, 0);
}

// Stripes that cancel within a tile are a difference of pixels and none of light.
TEST(RelativeSquares, Light_IsTheTilesMean) {
  const NoisyPicture truth{{flat(16, 1)}};
  NoisyPicture stripes = truth, brighter{{flat(16, 1.2f)}};
  for (std::size_t k = 0; k < stripes.batches[0].pixels.size(); ++k)
    if (k % 4 < 3) stripes.batches[0].pixels[k] += (k / 4) % 2 == 0 ? 0.2f : -0.2f;
  const RelativeSquares squares({&truth, &stripes, &brighter});
  EXPECT_NEAR(mean(squares.light(truth, stripes)), 0, 1e-9);
  EXPECT_NEAR(mean(squares.tiles(truth, stripes)), 0.02, 1e-6);
  EXPECT_NEAR(mean(squares.light(truth, brighter)), 0.02, 1e-6);
  const NoisyPicture noise = noisy(128, 1, 0.6f, 4, 1), other = noisy(128, 1.2f, 0.6f, 4, 2);
  const RelativeSquares without({&noise, &other});
  EXPECT_NEAR(mean(without.light(noise, other)), 0.02, 4 * standard_error(without.light(noise, other)));
  const NoisyPicture same = noisy(128, 1, 0.6f, 4, 3);
  EXPECT_LT(standard_error(without.light(noise, same)), 0.2 * standard_error(without.tiles(noise, same)));
}

TEST(RelativeSquares, StepsOfAWay_AddUpToItWithTheirProducts) {
  const NoisyPicture a = noisy(16, 1, 0.3f, 3, 1), b = noisy(16, 1.4f, 0.3f, 3, 2), c{{flat(16, 0.7f)}};
  const RelativeSquares squares({&a, &b, &c});
  const double first = squares.mean(a, b, a, b), second = squares.mean(b, c, b, c), both = squares.mean(a, b, b, c);
  EXPECT_NEAR(squares.mean(a, c, a, c), first + second + 2 * both, 1e-6);
}

TEST(RelativeSquares, PixelsWithoutHair_CountNowhere) {
  NoisyPicture truth{{flat(16, 1)}}, other{{flat(16, 1.5f)}};
  for (NoisyPicture* picture : {&truth, &other})
    for (std::size_t k = 0; k < 4 * 16 * 8; ++k) picture->batches[0].pixels[k] = 0;
  const std::vector<double> tiles = RelativeSquares({&truth, &other}).tiles(truth, other);
  EXPECT_EQ(tiles.size(), 2u);
  EXPECT_NEAR(mean(tiles), 0.125, 1e-6);
}

TEST(StrandSquares, AStrandTwiceAsBright_IsOffByItsShareOfTheMean) {
  NoisyPicture truth{{make_image(8, 1, {"R", "G", "B", "A"})}}, picture = truth;
  for (std::size_t k = 0; k < 32; ++k) {
    truth.batches[0].pixels[k] = 1;
    picture.batches[0].pixels[k] = k < 16 && k % 4 < 3 ? 2.0f : 1.0f;
  }
  const std::vector<double> squares = strand_squares(picture, truth, {0, 0, 0, 0, 1, 1, 1, -1});
  ASSERT_EQ(squares.size(), 1u);  // three pixels are too few
  EXPECT_NEAR(squares[0], 1, 1e-6);
}

TEST(ShownPicture, APixelThatOutshinesItsSurroundings_GivesThemItsLight) {
  NoisyPicture picture = noisy(16, 1, 0, 2, 1);
  for (Image& batch : picture.batches) batch.at(8, 8, 1) = 1000;
  const Image shown = shown_picture(picture);
  double sum = 0;
  for (std::size_t p = 0; p < 256; ++p) sum += double(shown.pixels[4 * p + 1]);
  EXPECT_NEAR(sum, 255 + 1000, 1e-2);
  EXPECT_LT(shown.at(8, 8, 1), 30);
  EXPECT_GT(shown.at(9, 9, 1), 8);
  EXPECT_EQ(shown.at(0, 0, 1), 1);
  picture.batches.resize(1);
  EXPECT_EQ(shown_picture(picture).pixels, picture.batches[0].pixels) << "without noise";
}

}  // namespace
}  // namespace cuticle::study::noisy_pictures_test
