// A good groom, and one for every mistake, which must be named.
#include "strands/check/groom_check.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::strands::check::groom_check_test {
namespace {

constexpr std::size_t k_strands = 400, k_size = 12;

/// Strands of 20 cm, side by side, that hang in an arc and taper.
Groom good() {
  Groom groom;
  for (std::size_t s = 0; s < k_strands; ++s) {
    for (std::size_t i = 0; i < k_size; ++i) {
      const float along = float(i) / float(k_size - 1);
      groom.positions.emplace_back(0.002f * float(s % 20), 0.2f * along, 0.002f * float(s / 20) + 0.05f * along * along);
      groom.radii.push_back(40e-6f * (1 - 0.5f * along));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

std::vector<std::string> mistakes(const Groom& groom) {
  EXPECT_TRUE(validate(groom));
  std::vector<std::string> names;
  for (const Verdict& verdict : check_groom(groom)) {
    EXPECT_EQ(verdict.passed, verdict.mistake.empty()) << verdict.check;
    EXPECT_EQ(verdict.passed, verdict.remedy.empty()) << verdict.check;
    EXPECT_FALSE(verdict.measured.empty()) << verdict.check;
    if (!verdict.passed) names.push_back(verdict.mistake);
  }
  return names;
}

TEST(GroomCheck, GoodGroom_PassesAll) {
  EXPECT_EQ(check_groom(good()).size(), 8u);
  EXPECT_THAT(mistakes(good()), testing::IsEmpty());
}

TEST(GroomCheck, CentimetresReadAsMetres_AreAWrongUnit) {
  Groom groom = good();
  for (glm::vec3& place : groom.positions) place *= 100;
  EXPECT_THAT(mistakes(groom), testing::ElementsAre("wrong_unit"));
}

TEST(GroomCheck, WidthsOfAnotherUnit_AreAWrongRadius) {
  for (const float factor : {100.0f, 0.01f}) {
    Groom groom = good();
    for (float& radius : groom.radii) radius *= factor;
    EXPECT_THAT(mistakes(groom), testing::ElementsAre("wrong_radius")) << factor;
  }
}

TEST(GroomCheck, OneRepeatedPoint_IsFound) {
  Groom groom = good();
  groom.positions[25] = groom.positions[24];
  EXPECT_THAT(mistakes(groom), testing::ElementsAre("repeated_points"));
}

TEST(GroomCheck, PointBesideAnother_IsUneven) {
  Groom groom = good();
  groom.positions[25] = groom.positions[24] + glm::vec3(0, 1e-6f, 0);
  EXPECT_THAT(mistakes(groom), testing::ElementsAre("uneven_points"));
}

TEST(GroomCheck, SwappedPointsInOneStrandOfTwenty_AreOutOfOrder) {
  Groom groom = good();
  for (std::size_t s = 0; s < k_strands; s += 20)
    std::swap(groom.positions[s * k_size + 4], groom.positions[s * k_size + 6]);
  EXPECT_THAT(mistakes(groom), testing::ElementsAre("points_out_of_order"));
}

TEST(GroomCheck, StrandsTurnedRound_AreTipFirst) {
  Groom groom = good();
  for (std::size_t s = 0; s < k_strands; ++s) {
    const auto begin = std::ptrdiff_t(s * k_size), end = begin + std::ptrdiff_t(k_size);
    std::reverse(groom.positions.begin() + begin, groom.positions.begin() + end);
    std::reverse(groom.radii.begin() + begin, groom.radii.begin() + end);
  }
  EXPECT_THAT(mistakes(groom), testing::ElementsAre("tip_first"));
}

TEST(GroomCheck, StrandsOfOneWidth_HaveNoDirectionToTell) {
  Groom groom = good();
  std::ranges::fill(groom.radii, 40e-6f);
  EXPECT_THAT(mistakes(groom), testing::IsEmpty());
}

TEST(GroomCheck, GroomPutTogetherTwice_HasStrandsTwice) {
  Groom groom = good();
  append(groom, good());
  EXPECT_THAT(mistakes(groom), testing::ElementsAre("strands_twice"));
}

TEST(GroomCheck, StrandFarAway_IsStray) {
  Groom groom = good();
  for (std::size_t i = 0; i < k_size; ++i) groom.positions[i].x += 4;
  EXPECT_THAT(mistakes(groom), testing::ElementsAre("stray_points"));
}

TEST(GroomCheck, NoStrands_AreSaidAlone) { EXPECT_THAT(mistakes(Groom{}), testing::ElementsAre("no_strands")); }

}  // namespace
}  // namespace cuticle::strands::check::groom_check_test
