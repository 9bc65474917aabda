#include <gtest/gtest.h>

#include "sim/rest_pose.h"

namespace cuticle::sim::rest_pose_test {
namespace {

/// Segments of 1, 2 and 5 cm, mean 8/3 cm.
strands::Groom growing_strand() {
  strands::Groom groom;
  for (float x : {0.f, 0.01f, 0.03f, 0.08f}) groom.positions.emplace_back(x, 0, 0);
  groom.radii.assign(4, strands::k_default_radius);
  groom.offsets.push_back(4);
  return groom;
}

TEST(RestPose, UnevenSegments_WeighHalfTheirNeighboursOverTheMean) {
  const RestPose pose = make_rest_pose(growing_strand(), 1);
  EXPECT_EQ(pose.traits[0].x, 0.f);
  EXPECT_NEAR(1 / pose.traits[1].x, 0.015f / 0.0266667f, 1e-5f);
  EXPECT_NEAR(1 / pose.traits[2].x, 0.035f / 0.0266667f, 1e-5f);
  EXPECT_NEAR(1 / pose.traits[3].x, 0.025f / 0.0266667f, 1e-5f);
}

TEST(RestPose, Lengths_AreOfTheSegmentTowardsTheRootAndTheLongestNeighbour) {
  const RestPose pose = make_rest_pose(growing_strand(), 1);
  EXPECT_NEAR(pose.places[2].w, 0.02f, 1e-8f);
  EXPECT_NEAR(pose.traits[2].w, 0.05f, 1e-8f);
  EXPECT_NEAR(pose.traits[2].y, 3.f / 8, 1e-6f);
}

TEST(RestPose, Reach_CountsFromTheLastCarriedVertex) {
  const RestPose pose = make_rest_pose(growing_strand(), 2);
  EXPECT_EQ(pose.traits[1].x, 0.f);
  EXPECT_EQ(pose.traits[1].z, 0.f);
  EXPECT_NEAR(pose.traits[3].z, 0.07f, 1e-8f);
}

TEST(RestPose, StrandWithoutLength_HasUnitMassesAndNoNaN) {
  strands::Groom groom;
  groom.positions.assign(3, glm::vec3(1, 2, 3));
  groom.offsets.push_back(3);
  const RestPose pose = make_rest_pose(groom, 1);
  EXPECT_EQ(pose.traits[2].x, 1.f);
  EXPECT_EQ(pose.traits[2].y, 0.f);
}

}  // namespace
}  // namespace cuticle::sim::rest_pose_test
