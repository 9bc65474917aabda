// BVH: a clip with known answers, damaged clips refused by line, and the repository's own clip.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "strands/motion/bvh.h"

namespace cuticle::strands::bvh_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string k_hierarchy = R"(HIERARCHY
ROOT Hips
{
  OFFSET 1 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT rig:Head
  {
    OFFSET 0 2 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 1 0
    }
  }
}
)";
const std::string k_clip = k_hierarchy + R"(MOTION
Frames: 2
Frame Time: 0.5
0 0 0 0 0 0 0 0 0
10 0 0 90 0 0 0 0 90
)";

Motion clip() { return parse_bvh(k_clip, "clip.bvh").value(); }
glm::dvec3 origin_of(const glm::dmat4& transform) { return glm::dvec3(transform[3]); }

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}
std::string refusal(const std::string& text) {
  const auto motion = parse_bvh(text, "bad.bvh");
  EXPECT_FALSE(motion.ok());
  return motion.ok() ? "" : motion.error().message;
}

TEST(Bvh, Structure_JointsChannelsFrames) {
  const Motion motion = clip();
  ASSERT_EQ(motion.joints.size(), 2u);
  EXPECT_EQ(motion.joints[1].parent, 0);
  EXPECT_EQ(motion.joints[1].first_channel, 6);
  EXPECT_EQ(motion.channel_count, 9u);
  EXPECT_EQ(motion.duration(), 0.5);
}

TEST(Bvh, FirstFrame_IsTheRestPose) { expect_near(origin_of(joint_transform(clip(), 1, 0)), {1, 2, 0}); }

TEST(Bvh, LastFrame_RootTurnsAndCarriesTheHead) {
  // The root moves 10 along x and turns 90 degrees about z, so the head's offset (0, 2, 0) points to -x.
  const glm::dmat4 world = joint_transform(clip(), 1, 0.5);
  expect_near(origin_of(world), {9, 0, 0});
  // The head turns 90 degrees about y first, then with the root about z: x -> -z -> -z.
  expect_near(glm::dvec3(world * glm::dvec4(1, 0, 0, 0)), {0, 0, -1});
}

TEST(Bvh, BetweenFrames_RotationIsSpherical) {
  const glm::dmat4 world = joint_transform(clip(), 0, 0.25);
  expect_near(glm::dvec3(world * glm::dvec4(1, 0, 0, 0)), {std::sqrt(0.5), std::sqrt(0.5), 0});
  expect_near(origin_of(world), {6, 0, 0});
}

TEST(Bvh, OutsideTheClip_IsClamped) {
  const Motion motion = clip();
  EXPECT_EQ(joint_transform(motion, 1, -3), joint_transform(motion, 1, 0));
  EXPECT_EQ(joint_transform(motion, 1, 1e9), joint_transform(motion, 1, 0.5));
  EXPECT_EQ(joint_transform(motion, 1, NAN), joint_transform(motion, 1, 0));
}

TEST(Bvh, ChannelOrder_IsTheOrderOfTheProduct) {
  const std::string text =
      replaced(replaced(k_clip, "Zrotation Xrotation Yrotation\n  JOINT", "Xrotation Yrotation Zrotation\n  JOINT"),
               "10 0 0 90 0 0", "10 0 0 90 90 0");
  // X(90) Y(90): x -> -z -> y.
  const glm::dmat4 world = joint_transform(parse_bvh(text, "clip.bvh").value(), 0, 0.5);
  expect_near(glm::dvec3(world * glm::dvec4(1, 0, 0, 0)), {0, 1, 0});
}

TEST(Bvh, FindJoint_IgnoresCaseAndPrefix) {
  EXPECT_EQ(*find_joint(clip(), "hips"), 0);
  EXPECT_EQ(*find_joint(clip(), "Head"), 1);
}

TEST(Bvh, UnknownJoint_ListsTheJoints) {
  const auto joint = find_joint(clip(), "Tail");
  ASSERT_FALSE(joint.ok());
  EXPECT_THAT(joint.error().message, AllOf(HasSubstr("Tail"), HasSubstr("Hips, rig:Head")));
}

TEST(Bvh, ChannelGivenTwice_IsRefused) {
  const std::string text =
      replaced(k_clip, "Zrotation Xrotation Yrotation\n  JOINT", "Zrotation Xrotation Zrotation\n  JOINT");
  EXPECT_THAT(parse_bvh(text, "clip.bvh").error().message, HasSubstr("Zrotation of joint 'Hips' is given twice"));
}

TEST(Bvh, UnknownJointOfAThousand_ListsSome) {
  Motion motion;
  for (int i = 0; i < 1000; ++i) motion.joints.emplace_back().name = "joint " + std::to_string(i);
  const std::string message = find_joint(motion, "Tail").error().message;
  EXPECT_THAT(message, HasSubstr("joint 39 and 960 more"));
  EXPECT_LT(message.size(), 1000u);
}

TEST(Bvh, CutBeforeTheLastNumber_IsRefused) {
  const std::size_t end = k_clip.find_last_of('9');
  for (std::size_t size = 0; size < end; ++size)
    ASSERT_FALSE(parse_bvh(k_clip.substr(0, size), "cut.bvh").ok()) << size;
}

TEST(Bvh, LyingFrameCount_IsRefusedBeforeAllocating) {
  for (const char* lie : {"100000000", "3000", "0", "-1", "99999999999999999999"})
    EXPECT_THAT(refusal(replaced(k_clip, "Frames: 2", std::string("Frames: ") + lie)),
                AllOf(HasSubstr("bad.bvh: line"), HasSubstr("Frames")));
}

TEST(Bvh, WrongWords_NamedWithLineAndWhatWasExpected) {
  EXPECT_THAT(refusal(replaced(k_clip, "OFFSET", "OFSET")), AllOf(HasSubstr("line 4"), HasSubstr("expected OFFSET")));
  EXPECT_THAT(refusal(replaced(k_clip, "Xrotation", "Wrotation")), AllOf(HasSubstr("line 5"), HasSubstr("Wrotation")));
  EXPECT_THAT(refusal(replaced(k_clip, "CHANNELS 6", "CHANNELS 7")), HasSubstr("0 .. 6"));
  EXPECT_THAT(refusal(replaced(k_clip, "0.5", "nan")), HasSubstr("Frame Time"));
  EXPECT_THAT(refusal(replaced(k_clip, "10 0 0", "10 x 0")), AllOf(HasSubstr("line 20"), HasSubstr("'x'")));
}

TEST(Bvh, OwnHeadTurn_TurnsLeftAndRight) {
  const auto motion = read_bvh(std::string(CUTICLE_SOURCE_DIR) + "/scenes/motion/head_turn.bvh");
  ASSERT_TRUE(motion.ok()) << motion.error().message;
  EXPECT_GE(1 / motion->frame_time, 29.9);
  double left = 0, right = 0;
  for (std::size_t frame = 0; frame < motion->frame_count; ++frame) {
    const glm::dmat4 world = joint_transform(*motion, *find_joint(*motion, "Head"), double(frame) * motion->frame_time);
    const double yaw = std::atan2(world[2].x, world[2].z) * 180 / std::acos(-1.0);
    left = std::max(left, yaw);
    right = std::min(right, yaw);
  }
  EXPECT_GT(left, 35);
  EXPECT_LT(right, -30);
}

}  // namespace
}  // namespace cuticle::strands::bvh_test
