// What real-time ways leave out, put into the path tracer one at a time.
#include "render/reference/restrictions.h"

#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "lut/format.h"
#include "lut/scattering_reader.h"
#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::restrictions_test {
namespace {

ShadowsInstead shadows_of(std::string_view method, const glm::dvec3& alpha) {
  const shadows::Method* found = shadows::find_method(method).value();
  return {std::string(method), registry::default_values(found->entry.parameters), alpha};
}

TraceOptions all_restrictions() {
  return {.scatterings = 1,
          .far_field = true,
          .tables = TablesInstead{"nalu", 16},
          .shadows = shadows_of("opacity_map", glm::dvec3(0.4))};
}

/// A far field, whose tables are baked at once.
TracedScene lit_marschner_ball() {
  TracedScene scene = scene_of("marschner", "");
  scene.hair = lit_ball().hair;
  scene.lights = lit_ball().lights;
  scene.camera = lit_ball().camera;
  return scene;
}

TEST(Restrictions, SwitchedOffAgain_SameBits) {
  const TracedScene scene = lit_marschner_ball();
  const Picture before = picture_of(scene, {}, {.samples = 4});
  TraceOptions options = all_restrictions();
  const Picture restricted = picture_of(scene, options, {.samples = 4});
  options.scatterings = 0;
  options.far_field = false;
  options.tables.reset();
  options.shadows.reset();
  EXPECT_EQ(before.layers.pixels, picture_of(scene, options, {.samples = 4}).layers.pixels);
  EXPECT_NE(before.layers.pixels, restricted.layers.pixels);
}

// Each changes the picture alone.
TEST(Restrictions, EachOfFour_ChangesThePicture) {
  const auto pixels = [](const TracedScene& scene, const TraceOptions& options) {
    return picture_of(scene, options, {.samples = 2}).color.pixels;
  };
  const TracedScene near = lit_ball(), far = lit_marschner_ball();
  const TraceOptions all = all_restrictions();
  EXPECT_NE(pixels(near, {}), pixels(near, {.far_field = all.far_field}));
  const auto whole = pixels(far, {});
  EXPECT_NE(whole, pixels(far, {.scatterings = all.scatterings}));
  EXPECT_NE(whole, pixels(far, {.tables = all.tables}));
  EXPECT_NE(whole, pixels(far, {.shadows = all.shadows}));
}

// The far field itself does not depend on where the fibre is met, so the mean over the width has no noise of h.
TEST(Restrictions, Tables_FibreIsAsBrightAsTheTablesSay) {
  TracedScene scene = one_fibre("marschner", "sigma_a=0.1/0.3/0.9");
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.5, 0.7, 0.2));
  scene.lights = {{.name = "key", .to_light = to_light, .irradiance = {1, 1, 1}}};
  lut::TableSet set =
      lut::bake(*scene.model, scene.values, *lut::find_layout("nalu").value(), 32, silent_progress()).value();
  ASSERT_TRUE(lut::store_as(set, lut::half_exr()).ok());
  const double theta_i = std::asin(to_light.x);
  const bsdf::Point at{.theta_i = theta_i,
                       .theta_o = 0,
                       .theta_d = theta_i / 2,
                       .phi = std::abs(std::atan2(to_light.z, to_light.y) - std::numbers::pi / 2)};
  scene.camera.vertical_field_of_view = 0.012;
  scene.camera.resolution = {1, 17};
  const Mean mean =
      mean_where_covered(picture_of(scene, {.scatterings = 1, .tables = TablesInstead{"nalu", 32}}, {.samples = 16}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.color[c] / lut::ScatteringReader(set).scattering(at, c), 1, 3e-3) << c;
}

// The other fibre is wider than the footprint over which the method takes its mean.
TEST(Restrictions, ShadowMethod_FibreBehindAnotherHasTheLightThatTheMethodLeaves) {
  TracedScene scene = one_fibre("kajiya_kay", "");
  scene.camera.position = {0, 0, 1};
  scene.lights = {{.name = "key", .to_light = {0, 1, 0}, .irradiance = {1, 1, 1}}};
  const Mean lit = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 16}));
  for (const glm::vec3 end : {glm::vec3(-2, 0.5f, 0), glm::vec3(2, 0.5f, 0)}) scene.hair.positions.push_back(end);
  scene.hair.radii = {1e-2f, 1e-2f, 0.1f, 0.1f};
  scene.hair.offsets = {0, 2, 4};
  const glm::dvec3 alpha(0.25, 0.5, 1);
  const Mean traced = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 16}));
  ShadowsInstead truth = shadows_of("truth", alpha);
  truth.values.set("footprint_radius_mm", 1.0);
  const Mean by_method = mean_where_covered(picture_of(scene, {.scatterings = 1, .shadows = truth}, {.samples = 16}));
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(traced.color[c], 0);
    EXPECT_NEAR(by_method.color[c] / lit.color[c], 1 - alpha[c], 1e-5) << c;
  }
}

TEST(Restrictions, ShadowMethod_IsAskedWithTheWidthOfTheFibres) {
  const TracedScene scene = lit_ball();
  ShadowsInstead shadows = shadows_of("deep_opacity", glm::dvec3(1));
  const auto light_by = [&](double fibre_width) {
    shadows.fibre_width = fibre_width;
    return mean_where_covered(picture_of(scene, {.scatterings = 1, .shadows = shadows}, {.samples = 16})).color.x;
  };
  EXPECT_GT(std::abs(light_by(0.1) / light_by(1) - 1), 1e-3);
}

// A surface between stands in the light of every method.
TEST(Restrictions, ShadowMethod_SurfaceStillBlocks) {
  TracedScene scene = one_fibre("kajiya_kay", "");
  scene.lights = {{.name = "key", .to_light = {0, 1, 0}, .irradiance = {1, 1, 1}}};
  Surface roof;
  roof.mesh.positions = {{-2, 0.5f, -1}, {2, 0.5f, -1}, {-2, 0.5f, 1}, {2, 0.5f, 1}};
  roof.mesh.normals.assign(4, glm::vec3(0, -1, 0));
  roof.mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  roof.albedo.assign(4, glm::vec3(0));
  const TraceOptions options{.scatterings = 1, .shadows = shadows_of("none", glm::dvec3(0.4))};
  EXPECT_GT(mean_where_covered(picture_of(scene, options, {.samples = 1})).color.x, 0);
  scene.surfaces = {roof};
  EXPECT_EQ(mean_where_covered(picture_of(scene, options, {.samples = 1})).color.x, 0);
}

TEST(Restrictions, WhatIsNotThere_IsRefused) {
  const TracedScene scene = lit_ball();
  const auto error = [&](const TraceOptions& options) {
    const auto made = trace_picture(scene, options, {.samples = 1}, silent_progress());
    return made.ok() ? std::string() : made.error().message;
  };
  EXPECT_THAT(error({.shadows = ShadowsInstead{.method = "opacity_maps"}}), testing::HasSubstr("opacity_maps"));
  EXPECT_THAT(error({.tables = TablesInstead{"dual_scattering", 32}}), testing::HasSubstr("do not make S"));
  EXPECT_THAT(error({.tables = TablesInstead{"nalu", 8}}), testing::HasSubstr("8"));
}

}  // namespace
}  // namespace cuticle::render::reference::restrictions_test
