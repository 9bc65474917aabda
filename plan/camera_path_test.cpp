// Where the camera is, frame by frame.
#include "plan/camera_path.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::plan::camera_path_test {
namespace {

const strands::Bounds k_bounds{{-0.1f, -0.2f, -0.1f}, {0.1f, 0.15f, 0.12f}};

Camera at(const scene::CameraPath& path, double seconds) { return camera_at(path, k_bounds, {.seconds = seconds}); }

TEST(CameraPath, Automatic_SeesTheWholeBox) {
  scene::CameraPath path;
  path.automatic = true;
  path.camera.resolution = {300, 500};
  const Camera camera = camera_at(path, k_bounds, {});
  const glm::dmat4 to_clip = projection_matrix(camera) * view_matrix(camera);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point(corner & 1 ? k_bounds.upper.x : k_bounds.lower.x,
                           corner & 2 ? k_bounds.upper.y : k_bounds.lower.y,
                           corner & 4 ? k_bounds.upper.z : k_bounds.lower.z);
    const glm::dvec4 clip = to_clip * glm::dvec4(point, 1);
    EXPECT_LE(std::abs(clip.x), clip.w);
    EXPECT_LE(std::abs(clip.y), clip.w);
    EXPECT_TRUE(clip.z >= 0 && clip.z <= clip.w);
  }
}

TEST(CameraPath, Given_IsKept) {
  scene::CameraPath path;
  path.camera.position = {1, 2, 3};
  EXPECT_EQ(camera_at(path, k_bounds, {.frame = 7}).position, glm::dvec3(1, 2, 3));
}

TEST(CameraPath, Turntable_KeepsDistanceAndComesRound) {
  scene::CameraPath path;
  path.camera.position = {1, 2, 3};
  path.camera.target = {0, 1, 0};
  path.turntable_degrees_per_frame = 30;
  const Camera quarter = camera_at(path, k_bounds, {.frame = 3});
  EXPECT_LT(glm::distance(quarter.position, glm::dvec3(3, 2, -1)), 1e-12);
  EXPECT_LT(glm::distance(camera_at(path, k_bounds, {.frame = 12}).position, path.camera.position), 1e-12);
}

TEST(CameraPath, Keys_AreMetAndHeldBeyondTheEnds) {
  scene::CameraPath path;
  path.keys = {{1, {0, 0, 3}, {0, 0, 0}, 0.4}, {2, {3, 0, 0}, {0, 1, 0}, 0.8}, {4, {0, 0, -3}, {0, 0, 0}, 0.4}};
  for (const scene::CameraKey& key : path.keys) {
    EXPECT_EQ(at(path, key.time).position, key.position);
    EXPECT_EQ(at(path, key.time).target, key.target);
    EXPECT_EQ(at(path, key.time).vertical_field_of_view, key.vertical_field_of_view);
  }
  EXPECT_EQ(at(path, -5).position, path.keys.front().position);
  EXPECT_EQ(at(path, 9).position, path.keys.back().position);
}

TEST(CameraPath, KeysOnALine_GiveEvenMotion) {
  scene::CameraPath path;
  for (const double time : {0.0, 1.0, 1.5, 4.0}) path.keys.push_back({time, {2 * time, 1, 5}, {2 * time, 0, 0}, 0.5});
  for (double time = 0; time <= 4; time += 0.1)
    EXPECT_LT(glm::distance(at(path, time).position, glm::dvec3(2 * time, 1, 5)), 1e-14) << time;
}

TEST(CameraPath, AtAKey_VelocityDoesNotJump) {
  scene::CameraPath path;
  path.keys = {{0, {0, 0, 3}, {0, 0, 0}, 0.5}, {1, {2, 1, 3}, {0, 0, 0}, 0.5}, {3, {0, 4, 2}, {0, 0, 0}, 0.5}};
  const double h = 1e-6;
  const glm::dvec3 before = (at(path, 1).position - at(path, 1 - h).position) / h,
                   after = (at(path, 1 + h).position - at(path, 1).position) / h;
  EXPECT_LT(glm::distance(before, after), 1e-4);
  EXPECT_LT(glm::distance(before, glm::dvec3(0, 4, -1) / 3.0), 1e-4);
}

TEST(CameraPath, TwoKeysAtOneTime_AreACut) {
  scene::CameraPath path;
  path.keys = {{0, {0, 0, 3}, {0, 0, 0}, 0.5},
               {1, {1, 0, 3}, {0, 0, 0}, 0.5},
               {1, {9, 9, 9}, {0, 0, 0}, 0.5},
               {2, {9, 9, 7}, {0, 0, 0}, 0.5}};
  EXPECT_LT(glm::distance(at(path, 0.5).position, glm::dvec3(0.5, 0, 3)), 1e-14) << "what follows a cut is not seen";
  EXPECT_EQ(at(path, 1).position, glm::dvec3(9));
  EXPECT_LT(glm::distance(at(path, 1.5).position, glm::dvec3(9, 9, 8)), 1e-14);
}

TEST(CameraPath, FollowingTheHead_TravelsWithIt) {
  scene::CameraPath path;
  path.camera.position = {1, 2, 3};
  path.camera.target = {0, 1, 0};
  const CameraTime when{.frame = 4, .head_travel = {0, 0.5, 2}};
  EXPECT_EQ(camera_at(path, k_bounds, when).position, path.camera.position);
  path.follows_head = true;
  EXPECT_EQ(camera_at(path, k_bounds, when).position, path.camera.position + when.head_travel);
  EXPECT_EQ(camera_at(path, k_bounds, when).target, path.camera.target + when.head_travel);
}

}  // namespace
}  // namespace cuticle::plan::camera_path_test
