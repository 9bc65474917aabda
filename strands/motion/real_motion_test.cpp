// The motion clips of CUTICLE_TEST_DATA: joints and frames as its README.md states them.
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "strands/motion/bvh.h"

namespace cuticle::strands::real_motion_test {
namespace {

Motion read(const std::string& path) {
  auto motion = read_bvh(std::string(std::getenv("CUTICLE_TEST_DATA")) + "/motion/" + path);
  EXPECT_TRUE(motion.ok()) << motion.error().message;
  return std::move(motion).value();
}

void expect_rigid_throughout(const Motion& motion) {
  const int head = find_joint(motion, "Head").value();
  for (int i = 0; i <= 50; ++i) {
    const glm::dmat3 turn(joint_transform(motion, head, motion.duration() * i / 50));
    ASSERT_NEAR(glm::determinant(turn), 1, 1e-9);
  }
}

TEST(RealMotion, Cmu0101_31JointsAnd2752FramesAt120Hz) {
  const Motion motion = read("cmu/01_01.bvh");
  EXPECT_EQ(motion.joints.size(), 31u);
  EXPECT_EQ(motion.frame_count, 2752u);
  EXPECT_NEAR(1 / motion.frame_time, 120, 0.01);
  expect_rigid_throughout(motion);
}

TEST(RealMotion, MakehumanWalk_75JointsAnd14Frames) {
  const Motion motion = read("makehuman/walk1.bvh");
  EXPECT_EQ(motion.joints.size(), 75u);
  EXPECT_EQ(motion.frame_count, 14u);
  expect_rigid_throughout(motion);
}

}  // namespace
}  // namespace cuticle::strands::real_motion_test
