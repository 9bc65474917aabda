#pragma once
// Scenes, pictures and means that the tests of the path tracer share.
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "render/reference/reference.h"

namespace cuticle::render::reference {

inline constexpr const char* k_clear = "sigma_a=0,beta_m=0.3,beta_n=0.3,alpha=0";

/// Radiance 1 from everywhere; `drawn`: uneven by a millionth, so that directions are drawn from it as well.
inline Surroundings white(bool drawn = true) {
  Surroundings surroundings{make_image(2, 1, {"R", "G", "B"})};
  for (float& value : surroundings.picture.pixels) value = 1;
  if (drawn) surroundings.picture.pixels[0] += 1e-6f;
  return surroundings;
}

inline TracedScene scene_of(std::string_view model, std::string_view settings) {
  TracedScene scene;
  scene.model = bsdf::find_model(model).value();
  scene.values = bsdf::parse_settings(*scene.model, "", settings).value();
  scene.camera.position = {0, 0, 1};
  scene.camera.resolution = {24, 24};
  return scene;
}

/// Straight fibres across a ball of 5 cm.
inline strands::Groom ball(int count, float radius) {
  std::mt19937 random(9);
  std::normal_distribution<float> normal;
  strands::Groom hair;
  for (int s = 0; s < count; ++s) {
    const glm::vec3 middle = 0.02f * glm::vec3(normal(random), normal(random), normal(random));
    const glm::vec3 along = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    for (int k = -2; k <= 2; ++k) hair.positions.push_back(middle + 0.012f * float(k) * along);
    hair.offsets.push_back(std::uint32_t(hair.positions.size()));
  }
  hair.radii.assign(hair.positions.size(), radius);
  return hair;
}

/// One fibre along x, seen across all of its width and a little more.
inline TracedScene one_fibre(std::string_view model, std::string_view settings) {
  TracedScene scene = scene_of(model, settings);
  scene.hair.positions = {{-1, 0, 0}, {1, 0, 0}};
  scene.hair.radii = {1e-2f, 1e-2f};
  scene.hair.offsets = {0, 2};
  scene.camera.vertical_field_of_view = 0.03;
  return scene;
}

inline Picture picture_of(const TracedScene& scene, const TraceOptions& options, const Quality& quality) {
  auto picture = trace_picture(scene, options, quality, silent_progress());
  EXPECT_TRUE(picture.ok()) << (picture.ok() ? "" : picture.error().message);
  return std::move(picture).value();
}

/// Mean of the colour where hair is, its standard error, and the mean coverage.
struct Mean {
  glm::dvec3 color{0}, error{0};
  double coverage = 0;
};
inline Mean mean_where_covered(const Picture& picture) {
  Mean mean;
  const Image& image = picture.layers;
  const int channels = image.channels();
  for (std::size_t p = 0; p < image.pixels.size() / std::size_t(channels); ++p) {
    const float* pixel = image.pixels.data() + p * std::size_t(channels);
    mean.coverage += double(pixel[3]);
    for (int c = 0; c < 3; ++c) {
      mean.color[c] += double(pixel[c]);
      mean.error[c] += double(pixel[4 + c]);
    }
  }
  for (int c = 0; c < 3; ++c) {
    mean.color[c] /= mean.coverage;
    mean.error[c] = std::sqrt(mean.error[c]) / mean.coverage;
  }
  return mean;
}

inline glm::dvec3 far_field(const TracedScene& scene, bsdf::Quantity quantity, const bsdf::Point& at) {
  registry::ParameterValues values = scene.values;
  if (scene.model->entry.name == "chiang") values.set("field", std::string("far"));
  std::vector<glm::dvec3> value(1);
  const bsdf::Request request{quantity, -1, {&at, 1}};
  EXPECT_TRUE(bsdf::evaluate(*scene.model, values, bsdf::Precision::f64, request, value).ok());
  return value[0];
}

inline TracedScene lit_ball() {
  TracedScene scene = scene_of("chiang", "sigma_a=0.06/0.1/0.2,beta_m=0.3,beta_n=0.3,alpha=0");
  scene.hair = ball(1000, 4e-4f);
  scene.lights = {{.name = "key", .to_light = glm::normalize(glm::dvec3(1, 1, 1)), .irradiance = {3, 3, 3}},
                  {.name = "rim", .to_light = {0, 0, -1}, .irradiance = {1, 2, 1}}};
  scene.camera.vertical_field_of_view = 0.08;
  return scene;
}

}  // namespace cuticle::render::reference
