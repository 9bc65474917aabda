#include <gtest/gtest.h>

#include <glm/vec4.hpp>

#include "core/view.h"

namespace cuticle::view_test {
namespace {

glm::dvec3 project(const Camera& camera, glm::dvec3 world) {
  const glm::dvec4 clip = projection_matrix(camera) * view_matrix(camera) * glm::dvec4(world, 1);
  return glm::dvec3(clip) / clip.w;
}

Camera camera_at_three_metres() {
  Camera camera;
  camera.position = {0, 0, 3};
  camera.near_plane = 1;
  camera.far_plane = 10;
  return camera;
}

TEST(Camera, ItsTarget_ProjectsToTheMiddle) {
  Camera camera;
  camera.position = {1, 2, 3};
  camera.target = {-0.5, 0.25, 0};
  const glm::dvec3 point = project(camera, camera.target);
  EXPECT_NEAR(point.x, 0, 1e-12);
  EXPECT_NEAR(point.y, 0, 1e-12);
}

TEST(Camera, UpInTheWorld_IsNegativeYInClip) {
  const Camera camera = camera_at_three_metres();
  EXPECT_LT(project(camera, {0, 0.1, 0}).y, 0);
  EXPECT_GT(project(camera, {0.1, 0, 0}).x, 0);
}

TEST(Camera, NearAndFarPlanes_HaveDepthZeroAndOne) {
  const Camera camera = camera_at_three_metres();
  EXPECT_NEAR(project(camera, {0, 0, 2}).z, 0, 1e-12);
  EXPECT_NEAR(project(camera, {0, 0, -7}).z, 1, 1e-12);
}

TEST(Camera, VerticalFieldOfView_ReachesTheEdge) {
  const Camera camera = camera_at_three_metres();
  EXPECT_NEAR(project(camera, {0, -3 * std::tan(camera.vertical_field_of_view / 2), 0}).y, 1, 1e-12);
}

TEST(Camera, LookingStraightDown_StaysFinite) {
  Camera camera;
  camera.position = {0, 5, 0};
  const glm::dvec3 point = project(camera, {0.1, 0, 0.1});
  EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
}

}  // namespace
}  // namespace cuticle::view_test
