// Published hashes, and weights of pictures whose objects are known.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/image/cryptomatte.h"
#include "core/json/json.h"

namespace cuticle::cryptomatte_test {
namespace {

// MurmurHash3 x86_32 with seed 0, by other programs: Appleby's SMHasher and the Python package mmh3.
TEST(MurmurHash, KnownTexts_GiveTheirPublishedNumbers) {
  EXPECT_EQ(murmur_hash(""), 0U);
  EXPECT_EQ(murmur_hash("a"), 0x3c2569b2U);
  EXPECT_EQ(murmur_hash("abc"), 0xb3dd93faU);
  EXPECT_EQ(murmur_hash("Hello, world!"), 0xc0363e43U);
  EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
}

TEST(MatteId, AnyName_IsAUsualNumber) {
  for (int k = 0; k < 200000; ++k) {
    const float id = matte_id("strand_" + std::to_string(k));
    ASSERT_TRUE(std::isnormal(id)) << k;
  }
}

std::string name_of(std::uint32_t object) { return object == 9 ? "" : "o" + std::to_string(object); }

TEST(Matte, ObjectsOfAPixel_StandFromTheMostToTheLeastWeight) {
  Image image = make_image(2, 1, {"R", "G", "B", "A"});
  std::map<std::string, std::string> attributes;
  const std::vector<SeenShare> shares = {{0, 1, 1, {0, 0, 0, 0.125F}},
                                         {0, 2, 2, {0, 0, 0, 0.5F}},
                                         {0, 1, 3, {0, 0, 0, 0.125F}},
                                         {1, 0, 1, {0, 0, 0, 1}},
                                         {1, 9, 1, {0, 0, 0, 1}}};
  add_matte(image, attributes, "strand", shares, name_of);
  ASSERT_EQ(image.channels(), 4 + 2 * k_matte_ranks);
  EXPECT_EQ(image.channel_names[4], "strand00.R");
  EXPECT_EQ(image.channel_names[15], "strand02.A");
  EXPECT_EQ(image.at(0, 0, 4), matte_id("o2"));
  EXPECT_EQ(image.at(0, 0, 5), 0.5F);
  EXPECT_EQ(image.at(0, 0, 6), matte_id("o1"));
  EXPECT_EQ(image.at(0, 0, 7), 0.25F);
  for (int c = 4; c < image.channels(); ++c) EXPECT_EQ(image.at(1, 0, c), 0) << c;
}

TEST(Matte, Attributes_NameEachObjectByItsHash) {
  Image image = make_image(1, 1, {"R"});
  std::map<std::string, std::string> attributes;
  const std::vector<SeenShare> shares = {{0, 1, 1, {0, 0, 0, 1}}};
  add_matte(image, attributes, "groom", shares, [](std::uint32_t) { return std::string("a \"tail\""); });
  ASSERT_EQ(attributes.size(), 4U);
  const auto manifest =
      std::ranges::find_if(attributes, [](const auto& each) { return each.first.ends_with("/manifest"); });
  const Json json = Json::parse(manifest->second).value();
  EXPECT_EQ(json.items().front().first, "a \"tail\"");
}

}  // namespace
}  // namespace cuticle::cryptomatte_test
