// Where head and camera are, frame by frame.
#include <cuticle/plan/head_path.h>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::plan::head_path_test {
namespace {

const strands::Bounds k_bounds{{-0.1f, -0.2f, -0.1f}, {0.1f, 0.15f, 0.12f}};

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
TEST(HeadPath, HeadTurn_ReachesTheAngleOfTheClip) { EXPECT_NEAR(yaw(place(1, 18)), 42 * std::numbers::pi / 180, 5e-3) << "the nod turns the axis a little"; }

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

TEST(CameraPath, Automatic_SeesTheWholeBox) {
  scene::CameraPath path;
  path.automatic = true;
  path.camera.resolution = {300, 500};
  const Camera camera = camera_at(path, k_bounds, 0);
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
  EXPECT_EQ(camera_at(path, k_bounds, 7).position, glm::dvec3(1, 2, 3));
}

TEST(CameraPath, Turntable_KeepsDistanceAndComesRound) {
  scene::CameraPath path;
  path.camera.position = {1, 2, 3};
  path.camera.target = {0, 1, 0};
  path.turntable_degrees_per_frame = 30;
  const Camera quarter = camera_at(path, k_bounds, 3);
  EXPECT_LT(glm::distance(quarter.position, glm::dvec3(3, 2, -1)), 1e-12);
  EXPECT_LT(glm::distance(camera_at(path, k_bounds, 12).position, path.camera.position), 1e-12);
}

}  // namespace
}  // namespace cuticle::plan::head_path_test
