// An open shutter: hair and camera that move.
#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::motion_test {
namespace {

std::vector<glm::vec3> moved(const strands::Groom& hair, const glm::vec3& way) {
  std::vector<glm::vec3> positions = hair.positions;
  for (glm::vec3& position : positions) position += way;
  return positions;
}

TEST(Motion, NothingThatMoves_IsThePictureAtRest) {
  TracedScene scene = lit_ball();
  const Mean rest = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 8}));
  scene.positions_at_end = scene.hair.positions;
  scene.camera_at_end = scene.camera;
  const Mean still = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 8}));
  EXPECT_NEAR(still.coverage / rest.coverage, 1, 1e-4);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(still.color[c] / rest.color[c], 1, 1e-3) << c;
}

/// Coverage of rows of pixels.
std::vector<double> rows_of(const Picture& picture) {
  const Image& image = picture.color;
  std::vector<double> rows;
  for (int y = 0; y < image.height; ++y) {
    rows.push_back(0);
    for (int x = 0; x < image.width; ++x) rows.back() += double(image.at(x, y, 3)) / image.width;
  }
  return rows;
}

// A fibre that moves by twice its width covers a trapezium: half of it everywhere in the middle of its way.
TEST(Motion, FibreAcrossThePicture_CoversByTheTimeThatItIsThere) {
  TracedScene scene = one_fibre("kajiya_kay", "");
  scene.positions_at_end = moved(scene.hair, {0, 0.04f, 0});
  scene.camera.position = {0, 0.02, 10};
  scene.camera.target = {0, 0.02, 0};
  scene.camera.vertical_field_of_view = 0.008;  // from y = -.02 to .06
  scene.camera.resolution = {8, 32};
  const std::vector<double> rows = rows_of(picture_of(scene, {.scatterings = 1}, {.samples = 512}));
  for (int y = 0; y < 32; ++y) {
    const double height = 0.06 - (y + 0.5) * 0.08 / 32;
    const double expected = std::clamp((0.03 - std::abs(height - 0.02)) / 0.04, 0.0, 0.5);
    EXPECT_NEAR(rows[std::size_t(y)], expected, 0.04) << y;
  }
}

// What the camera does backwards is what the hair does.
TEST(Motion, CameraMovesTheOtherWay_SamePicture) {
  TracedScene scene = one_fibre("kajiya_kay", "");
  scene.lights = {{.name = "key", .to_light = {0, 0, 1}, .irradiance = {1, 1, 1}}};
  TracedScene by_camera = scene;
  scene.positions_at_end = moved(scene.hair, {0, 0.02f, 0});
  by_camera.camera_at_end = scene.camera;
  by_camera.camera_at_end->position.y -= 0.02;
  by_camera.camera_at_end->target.y -= 0.02;
  const Picture a = picture_of(scene, {.scatterings = 1}, {.samples = 16}),
                b = picture_of(by_camera, {.scatterings = 1}, {.samples = 16});
  const std::vector<double> rows_a = rows_of(a), rows_b = rows_of(b);
  for (std::size_t y = 0; y < rows_a.size(); ++y) EXPECT_NEAR(rows_a[y], rows_b[y], 0.01) << y;
  EXPECT_NEAR(mean_where_covered(a).color.y / mean_where_covered(b).color.y, 1, 1e-3);
}

TEST(Motion, OtherNumberOfVertices_IsRefused) {
  TracedScene scene = lit_ball();
  scene.positions_at_end = {{0, 0, 0}};
  EXPECT_FALSE(trace_picture(scene, {}, {.samples = 1}, silent_progress()).ok());
}

// A plate that passes a fibre stands before it for half of the time, and is seen where it is.
TEST(Motion, SurfaceThatMoves_CoversForTheTimeThatItIsThere) {
  TracedScene scene = one_fibre("kajiya_kay", "");
  scene.lights = {{.name = "key", .to_light = {0, 0, 1}, .irradiance = {1, 1, 1}}};
  const Mean lit = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 512}));
  Surface plate;
  plate.mesh.positions = {{-2, 1, 0.5f}, {2, 1, 0.5f}, {-2, 4, 0.5f}, {2, 4, 0.5f}};
  plate.mesh.normals.assign(4, glm::vec3(0, 0, 1));
  plate.mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  plate.albedo.assign(4, glm::vec3(0));
  plate.at_end = plate.mesh;
  for (glm::vec3& position : plate.at_end.positions) position.y -= 2;
  scene.surfaces = {plate};
  const Mean passed = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 512}));
  const double pixels = 24 * 24;
  EXPECT_NEAR(passed.color.x * passed.coverage / (lit.color.x * lit.coverage), 0.5, 0.01);
  EXPECT_NEAR(passed.coverage / pixels, 0.5 + 0.5 * lit.coverage / pixels, 0.01);
}

}  // namespace
}  // namespace cuticle::render::reference::motion_test
