#include "core/keyed_motion.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::keyed_motion_test {
namespace {

glm::dquat about_y(double angle) { return glm::angleAxis(angle, glm::dvec3(0, 1, 0)); }
MotionKey key(double time, const glm::dvec3& position, double angle = 0) { return {time, {about_y(angle), position}}; }

double apart(const glm::dquat& a, const glm::dquat& b) { return std::min(glm::length(a - b), glm::length(a + b)); }

TEST(KeyedMotion, BetweenKeys_IsLinearAndTurnsAtConstantSpeed) {
  const KeyedMotion motion{{key(1, {1, 0, 0}), key(3, {2, -4, 0}, 2.5), key(4, {2, -4, 0}, 5)}};
  for (double time : {1.0, 1.3, 2.9, 3.0, 3.7, 4.0}) {
    const Placement place = motion.at(time);
    const double share = std::min(1.0, (time - 1) / 2);
    EXPECT_LT(glm::length(place.position - glm::dvec3(1 + share, -4 * share, 0)), 1e-15) << time;
    EXPECT_LT(apart(place.rotation, about_y(time < 3 ? 1.25 * (time - 1) : 2.5 * (time - 2))), 1e-15) << time;
  }
}

TEST(KeyedMotion, OutsideTheKeys_IsHeld) {
  const KeyedMotion motion{{key(1, {1, 0, 0}), key(3, {2, -4, 0}, 1)}};
  EXPECT_EQ(motion.at(-5), motion.keys[0].place);
  EXPECT_EQ(motion.at(30), motion.keys[1].place);
  EXPECT_EQ(KeyedMotion{}.at(2), Placement{});
}

TEST(KeyedMotion, TwoKeysAtOneTime_AreAJumpThatIsNoMotion) {
  const KeyedMotion motion{{key(0, {0, 0, 0}), key(1, {1, 0, 0}), key(1, {7, 0, 0}), key(2, {8, 0, 0})}};
  EXPECT_NEAR(motion.at(1 - 1e-9).position.x, 1, 1e-8);
  EXPECT_EQ(motion.at(1).position.x, 7);
  EXPECT_EQ(motion.departure(0.9, 1).position.x, 7);
  EXPECT_EQ(motion.departure(0.9, 1.1).position.x, 7);
  EXPECT_NEAR(motion.departure(0.5, 0.9).position.x, 0.5, 1e-15);
  EXPECT_EQ(motion.departure(1, 1.1).position.x, 7);
  EXPECT_NEAR(motion.departure(1.5, 2).position.x, 7.5, 1e-15);
}

TEST(KeyedMotion, Rests_OnlyWhereNothingMoves) {
  const KeyedMotion there_and_back{{key(1, {1, 0, 0}), key(2, {2, 0, 0}), key(3, {1, 0, 0}), key(4, {1, 0, 0})}};
  EXPECT_TRUE(there_and_back.rests(-1, 1));
  EXPECT_TRUE(there_and_back.rests(3, 9));
  EXPECT_FALSE(there_and_back.rests(1, 3));
  EXPECT_FALSE(there_and_back.rests(1.2, 1.3));
}

TEST(KeyedMotion, WhatIsNoMotion_IsRefusedByName) {
  const auto message = [](const KeyedMotion& motion) {
    const Result<void> result = check(motion, "m");
    return result.ok() ? "" : result.error().message;
  };
  EXPECT_EQ(message({{key(0, {}), key(0, {}), key(1, {})}}), "");
  EXPECT_THAT(message({{key(1, {}), key(0.5, {})}}), ::testing::HasSubstr("m.keys[1]: time 0.5 s is before"));
  EXPECT_THAT(message({{key(0, {std::nan(""), 0, 0})}}), ::testing::HasSubstr("m.keys[0]"));
  EXPECT_THAT(message({{{0, {glm::dquat(2, 0, 0, 0), {}}}}}), ::testing::HasSubstr("length 2"));
}

}  // namespace
}  // namespace cuticle::keyed_motion_test
