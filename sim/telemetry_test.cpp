#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/telemetry.h"

namespace cuticle::sim::telemetry_test {
namespace {

using ::testing::HasSubstr;

/// Two strands of two segments; the second of the second strand is 1.5 times its rest length.
strands::Groom two_strands() {
  strands::Groom groom;
  groom.offsets = {0, 3, 6};
  for (int s = 0; s < 2; ++s)
    for (int i = 0; i < 3; ++i) groom.positions.emplace_back(0.1f * float(i), float(s), 0.f);
  groom.radii.assign(6, strands::k_default_radius);
  return groom;
}
State stretched(const strands::Groom& groom) {
  State state{groom.positions, std::vector<glm::vec3>(groom.vertex_count(), glm::vec3(0)), {}, 2};
  state.positions[5].x += 0.05f;
  return state;
}

TEST(Stretch, SegmentsAtTheirVertexTowardsTheTip) {
  const strands::Groom groom = two_strands();
  const std::vector<float> ratios = stretch(groom, stretched(groom).positions);
  EXPECT_EQ(ratios[3], 1.f);
  EXPECT_NEAR(ratios[5], 1.5f, 1e-6f);
}

TEST(Telemetry, OneSegmentStretched_IsTheLargestAndMovesTheMean) {
  const strands::Groom groom = two_strands();
  const Telemetry telemetry = measure(groom, stretched(groom));
  EXPECT_NEAR(telemetry.largest_stretch, 1.5, 1e-6);
  EXPECT_NEAR(telemetry.mean_stretch, 1.125, 1e-6);
  EXPECT_EQ(telemetry.guards_fired, 2u);
}

TEST(Curvature, OfACircle_IsOneOverItsRadius) {
  strands::Groom groom;
  for (int i = 0; i < 9; ++i) groom.positions.emplace_back(0.05 * std::cos(0.01 * i), 0.05 * std::sin(0.01 * i), 0);
  groom.radii.assign(9, strands::k_default_radius);
  groom.offsets = {0, 9};
  const std::vector<float> bent = curvature(groom, groom.positions);
  EXPECT_EQ(bent[0], 0.f);
  EXPECT_NEAR(bent[4], 20, 0.02);
}

TEST(Curvature, OfAFold_IsBounded) {
  strands::Groom groom;
  groom.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  groom.radii.assign(4, strands::k_default_radius);
  groom.offsets = {0, 4};
  for (float bent : curvature(groom, groom.positions)) EXPECT_TRUE(bent >= 0 && bent <= 1e6f);
}

TEST(Telemetry, NoSegments_ReadsOne) {
  const strands::Groom none;
  EXPECT_EQ(measure(none, State{}).largest_stretch, 1.0);
}

TEST(Telemetry, StateThatIsNotFinite_IsNamedByFrameStrandAndVertex) {
  const strands::Groom groom = two_strands();
  State state = stretched(groom);
  EXPECT_TRUE(check_finite(groom, state, 7).ok());
  state.velocities[4].y = NAN;
  const Result<void> result = check_finite(groom, state, 7);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, HasSubstr("frame 7, strand 1, vertex 1: velocity"));
}

TEST(Telemetry, Row_HasTheColumnsOfTheHeader) {
  const std::string header = telemetry_header(), row = telemetry_row(3, 0.1, {1.5, 1.01, 9, 30, 2});
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
  EXPECT_EQ(row, "3,0.1,1.5,1.01,9,30,2\n");
}

TEST(Effects, UnknownName_SuggestsTheNearest) {
  const auto found = find_effect("gravty");
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().hint, HasSubstr("gravity"));
}

}  // namespace
}  // namespace cuticle::sim::telemetry_test
