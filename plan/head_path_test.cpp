// Where the head is, frame by frame.
#include "plan/head_path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::plan::head_path_test {
namespace {

scene::Scene turning(double amplitude) {
  scene::Scene scene;
  scene.frames_per_second = 30;
  scene.motion = scene::MotionSource{CUTICLE_SOURCE_DIR "/scenes/motion/head_turn.bvh", "Head", 0, amplitude};
  return scene;
}

glm::dmat4 place(double amplitude, int frame, const glm::dvec3& pivot = glm::dvec3(0)) {
  const auto path = HeadPath::create(turning(amplitude), pivot);
  EXPECT_TRUE(path) << (path ? "" : path.error().message);
  return path->at(frame);
}

double largest_difference(const glm::dmat4& a, const glm::dmat4& b) {
  double largest = 0;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) largest = std::max(largest, std::abs(a[c][r] - b[c][r]));
  return largest;
}

/// Angle that +z is turned by about +y, radians.
double yaw(const glm::dmat4& head) { return std::atan2(head[2].x, head[2].z); }

TEST(HeadPath, FrameZero_IsRest) { EXPECT_EQ(place(1, 0), glm::dmat4(1)); }

TEST(HeadPath, NoMotion_IsRestAlways) {
  const auto path = HeadPath::create(scene::Scene(), glm::dvec3(0));
  ASSERT_TRUE(path);
  EXPECT_EQ(path->at(40), glm::dmat4(1));
}

// The clip turns the head 42 degrees to the left at 0.55 s, as scenes/motion/make_head_turn.py says.
TEST(HeadPath, HeadTurn_ReachesTheAngleOfTheClip) {
  EXPECT_NEAR(yaw(place(1, 18)), 42 * std::numbers::pi / 180, 5e-3) << "the nod turns the axis a little";
}

TEST(HeadPath, Amplitude_ScalesTheAngle) {
  EXPECT_LT(largest_difference(place(0, 18), glm::dmat4(1)), 1e-12);
  EXPECT_NEAR(yaw(place(0.5, 18)), 0.5 * yaw(place(1, 18)), 2e-3);
}

TEST(HeadPath, Pivot_StandsStill) {
  const glm::dvec3 pivot(0.1, 1.5, -0.2);
  EXPECT_LT(glm::distance(glm::dvec3(place(1, 18, pivot) * glm::dvec4(pivot, 1)), pivot), 1e-12);
}

TEST(HeadPath, UnknownJoint_IsAnError) {
  scene::Scene scene = turning(1);
  scene.motion->joint = "Tail";
  EXPECT_FALSE(HeadPath::create(scene, glm::dvec3(0)));
}

TEST(HeadPath, WithMetresPerUnit_TravelsAsTheJointDoes) {
  const glm::dvec3 pivot(0, 1.5, 0);
  scene::Scene scene = turning(0);
  EXPECT_EQ(HeadPath::create(scene, pivot)->travel(12), glm::dvec3(0));
  scene.motion->metres_per_unit = 0.01;
  scene.motion->start_time = 0.2;
  const HeadPath path = *HeadPath::create(scene, pivot);
  const strands::Motion clip = *strands::read_bvh(scene.motion->bvh);
  const int joint = *strands::find_joint(clip, "Head");
  const glm::dvec3 way(strands::joint_transform(clip, joint, 0.2 + 0.4)[3] -
                       strands::joint_transform(clip, joint, 0.2)[3]);
  ASSERT_GT(glm::length(way), 1e-3) << "the clip's joint stands still";
  EXPECT_EQ(path.travel(0), glm::dvec3(0));
  EXPECT_LT(glm::distance(path.travel(12), 0.01 * way), 1e-12);
  EXPECT_LT(glm::distance(glm::dvec3(path.at(12) * glm::dvec4(pivot, 1)), pivot + 0.01 * way), 1e-12);
}

}  // namespace
}  // namespace cuticle::plan::head_path_test
