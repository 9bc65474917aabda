// Philox4x32-10 against the answers published with Random123 and against whole-number arithmetic in Python.
#include <array>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/support/csv_table.h"

namespace cuticle::philox_test {
namespace {

using Words = std::array<std::uint32_t, 4>;

Words words(const PhiloxBlock& block) { return {block.a, block.b, block.c, block.d}; }

TEST(Philox, OfZeros_GivesThePublishedAnswer) {
  EXPECT_EQ(words(philox({0, 0, 0, 0}, 0, 0)), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
}

TEST(Philox, OfOnes_GivesThePublishedAnswer) {
  const uint ones = 0xffffffff;
  EXPECT_EQ(words(philox({ones, ones, ones, ones}, ones, ones)), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

TEST(Philox, OfTheDigitsOfPi_GivesThePublishedAnswer) {
  const PhiloxBlock counter{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344};
  EXPECT_EQ(words(philox(counter, 0xa4093822, 0x299f31d0)), (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, OfRandomCounters_MatchesWholeNumberArithmetic) {
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/core/shared/reference/philox.csv")) {
    const auto word = [&](const char* column) { return uint(row.whole(column)); };
    const PhiloxBlock counter{word("counter_a"), word("counter_b"), word("counter_c"), word("counter_d")};
    EXPECT_EQ(words(philox(counter, word("key_0"), word("key_1"))), (Words{word("a"), word("b"), word("c"), word("d")}));
  }
}

TEST(UnitInterval, OfTheExtremes_StaysBelowOne) {
  float low = -1, high = -1;
  unit_interval(0u, low);
  unit_interval(0xffffffffu, high);
  EXPECT_EQ(low, 0.0f);
  EXPECT_LT(high, 1.0f);
}

TEST(UnitInterval, InFloatAndDouble_IsTheSameNumber) {
  for (uint word : {1u, 255u, 256u, 0x12345678u, 0xdeadbeefu}) {
    float single = 0;
    double twice = 0;
    unit_interval(word, single);
    unit_interval(word, twice);
    EXPECT_EQ(double(single), twice);
  }
}

TEST(RandomStream, FirstWords_AreTheFirstBlock) {
  RandomStream stream(0);
  EXPECT_EQ(stream.next_word(), 0x6627e8d5u);
  EXPECT_EQ(stream.next_word(), 0xe169c58du);
}

TEST(RandomStream, Moments_AreThoseOfAUniform) {
  RandomStream stream(7, 3);
  constexpr int count = 100000;
  double mean = 0, square = 0;
  for (int i = 0; i < count; ++i) {
    const double u = stream.next_unit();
    mean += u / count;
    square += u * u / count;
  }
  EXPECT_NEAR(mean, 0.5, 4 * 0.2887 / std::sqrt(count));
  EXPECT_NEAR(square, 1.0 / 3, 4 * 0.2981 / std::sqrt(count));
}

TEST(RandomStream, OtherStreamsOfASeed_Differ) {
  RandomStream first(7, 0), second(7, 1);
  int equal = 0;
  for (int i = 0; i < 1000; ++i) equal += first.next_word() == second.next_word();
  EXPECT_EQ(equal, 0);
}

}  // namespace
}  // namespace cuticle::philox_test
