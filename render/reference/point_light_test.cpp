// Point lights and suns of some size.
#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::point_light_test {
namespace {

/// A white floor at y = 0 seen from above, without hair.
TracedScene floor_scene() {
  TracedScene scene = scene_of("kajiya_kay", "");
  Surface floor;
  floor.mesh.positions = {{-2, 0, -2}, {2, 0, -2}, {-2, 0, 2}, {2, 0, 2}};
  floor.mesh.normals.assign(4, glm::vec3(0, 1, 0));
  floor.mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
  floor.albedo.assign(4, glm::vec3(1));
  scene.surfaces = {floor};
  scene.camera.position = {0, 3, 0};
  scene.camera.target = {0, 0, 0};
  scene.camera.up = {0, 0, -1};
  scene.camera.vertical_field_of_view = 0.3;
  return scene;
}

TracedScene floor_under_point_light() {
  TracedScene scene = floor_scene();
  scene.lights = {
      {.name = "point_light", .point_light = PointLight{.position = {0.3, 1, 0.2}, .intensity = glm::dvec3(2)}}};
  return scene;
}

double mean_green(const TracedScene& scene, const TraceOptions& options) {
  return mean_where_covered(picture_of(scene, options, {.samples = 32})).color.y;
}

// The irradiance of a sphere of even radiance that is wholly above a plane is that of a point in its middle.
TEST(PointLight, SphereAboveAFloor_LightsItAsAPoint) {
  const TracedScene scene = floor_under_point_light();
  const double point = mean_green(scene, {.scatterings = 1});
  for (const double radius : {0.01, 0.3, 0.6})
    EXPECT_NEAR(mean_green(scene, {.scatterings = 1, .point_light_radius = radius}) / point, 1, 2e-3) << radius;
}

TEST(PointLight, SunOfSomeAngle_LightsAFloorAsAPoint) {
  TracedScene scene = floor_scene();
  scene.lights = {{.name = "sun", .to_light = glm::normalize(glm::dvec3(0.3, 1, 0.1)), .irradiance = glm::dvec3(2)}};
  const double point = mean_green(scene, {.scatterings = 1});
  for (const double angle : {0.005, 0.3, 0.9})
    EXPECT_NEAR(mean_green(scene, {.scatterings = 1, .sun_angle = angle}) / point, 1, 2e-3) << angle;
}

/// Share of pixels that are neither lit in full nor dark.
double half_lit(const TracedScene& scene, const TraceOptions& options) {
  const Image image = picture_of(scene, options, {.samples = 64}).color;
  float most = 0;
  for (int p = 0; p < image.width * image.height; ++p) most = std::max(most, image.pixels[std::size_t(4 * p + 1)]);
  int count = 0;
  for (int p = 0; p < image.width * image.height; ++p) {
    const float share = image.pixels[std::size_t(4 * p + 1)] / most;
    count += int(share > 0.15f && share < 0.7f);
  }
  return double(count) / (image.width * image.height);
}

// The half shadow of an edge at half the point light's height is as wide as the point light.
TEST(PointLight, ShadowOfAnEdge_IsSoftByThePointLightsWidth) {
  TracedScene scene = floor_scene();
  scene.lights = {
      {.name = "point_light", .point_light = PointLight{.position = {0, 1, 0}, .intensity = glm::dvec3(2)}}};
  Surface edge = scene.surfaces[0];
  edge.mesh.positions = {{-3, 0.5f, -3}, {0, 0.5f, -3}, {-3, 0.5f, 3}, {0, 0.5f, 3}};
  edge.albedo.assign(4, glm::vec3(0));
  scene.surfaces.push_back(edge);
  scene.camera.position = {2, 1.5, 0};
  scene.camera.target = {0, 0, 0};
  scene.camera.vertical_field_of_view = 0.12;
  EXPECT_LT(half_lit(scene, {.scatterings = 1}), 0.06);
  EXPECT_GT(half_lit(scene, {.scatterings = 1, .point_light_radius = 0.15}), 0.15);
}

}  // namespace
}  // namespace cuticle::render::reference::point_light_test
