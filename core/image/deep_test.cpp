// Samples in depth against the sums that they are made of, read back by OpenImageIO.
#include <filesystem>
#include <random>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include "core/image/deep.h"

namespace cuticle::deep_test {
namespace {

constexpr int k_width = 8, k_height = 5;

/// Objects of random depths, each seen behind those before it.
std::vector<SeenShare> random_shares() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<SeenShare> shares;
  for (std::uint32_t pixel = 0; pixel < k_width * k_height; ++pixel) {
    float left = 1;
    const std::uint32_t count = pixel % 7;
    for (std::uint32_t k = 0; k < count; ++k) {
      const float share = left * unit(random), depth = 1 + unit(random);
      const float red = unit(random), green = unit(random), blue = unit(random);
      shares.push_back({pixel, 1 + k % 4, depth, glm::vec4(red, green, blue, 1) * share});
      left -= share;
    }
  }
  return shares;
}

std::vector<glm::dvec4> sums_of(const std::vector<SeenShare>& shares) {
  std::vector<glm::dvec4> sums(k_width * k_height, glm::dvec4(0));
  for (const SeenShare& share : shares) sums[share.pixel] += glm::dvec4(share.light);
  return sums;
}

TEST(DeepImage, LaidOverEachOther_IsTheSumOfTheShares) {
  const std::vector<SeenShare> shares = random_shares();
  const Image flat = flatten(deep_image({k_width, k_height}, shares));
  const std::vector<glm::dvec4> sums = sums_of(shares);
  for (std::size_t p = 0; p < sums.size(); ++p)
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(flat.pixels[4 * p + std::size_t(c)], sums[p][c], 2e-6) << p;
}

TEST(DeepImage, SharesOfOneObject_AreOneSampleAtTheirMeanDepth) {
  const DeepImage deep = deep_image(
      {1, 1}, {{0, 3, 2, {0.25F, 0, 0, 0.25F}}, {0, 5, 1, {0, 0.5F, 0, 0.5F}}, {0, 3, 4, {0.25F, 0, 0, 0.25F}}});
  ASSERT_EQ(deep.samples.size(), 2U);
  EXPECT_EQ(deep.samples[0].object, 5U);
  EXPECT_EQ(deep.samples[1].depth, 3);
  EXPECT_EQ(deep.samples[1].color, glm::vec4(1, 0, 0, 1));
}

TEST(DeepExr, ReadAndFlattenedByOpenImageIO_IsTheSameWithinAThousandth) {
  const std::vector<SeenShare> shares = random_shares();
  const std::string path =
      (std::filesystem::temp_directory_path() / ("cuticle_deep_" + std::to_string(::getpid()) + ".exr")).string();
  ASSERT_TRUE(write_deep_exr(path, deep_image({k_width, k_height}, shares), {{"model", "chiang"}}));
  OIIO::ImageBuf deep(path);
  ASSERT_TRUE(deep.read(0, 0, true, OIIO::TypeDesc::UNKNOWN)) << deep.geterror();
  EXPECT_TRUE(deep.spec().deep);
  EXPECT_EQ(deep.spec().get_string_attribute("model"), "chiang");
  const OIIO::ImageBuf flat = OIIO::ImageBufAlgo::flatten(deep);
  const auto at = [&](const char* name) { return flat.spec().channelindex(name); };
  const int channels[] = {at("R"), at("G"), at("B"), at("A")};
  const std::vector<glm::dvec4> sums = sums_of(shares);
  for (int p = 0; p < k_width * k_height; ++p)
    for (int c = 0; c < 4; ++c)
      EXPECT_NEAR(flat.getchannel(p % k_width, p / k_width, 0, channels[c]), sums[std::size_t(p)][c], 1e-3)
          << p << " " << c;
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace cuticle::deep_test
