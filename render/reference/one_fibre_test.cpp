// One fibre and one light: what a picture of it integrates to, and how bright it is from all around.
#include <numbers>

#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::one_fibre_test {
namespace {

struct ModelCase {
  std::string_view model, settings;
};
void PrintTo(const ModelCase& of, std::ostream* out) { *out << of.model; }

class OneFibre : public testing::TestWithParam<ModelCase> {};

// L = S E, without a cosine.
TEST_P(OneFibre, DistantLight_MeanOverTheWidthIsTheFarField) {
  TracedScene scene = one_fibre(GetParam().model, GetParam().settings);
  for (const glm::dvec3& to_light : {glm::dvec3(0, 0, 1), glm::dvec3(0.5, 0.7, 0.2), glm::dvec3(-0.3, -0.2, -0.9)}) {
    scene.lights = {{.name = "key", .to_light = glm::normalize(to_light), .irradiance = {1, 2, 3}}};
    const Mean mean = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 64}));
    const glm::dvec3 light = scene.lights[0].to_light;
    const glm::dvec3 s = far_field(scene, bsdf::Quantity::S,
                                   {.theta_i = std::asin(light.x),
                                    .theta_o = 0,
                                    .phi = std::atan2(1.0, 0.0) - std::atan2(light.z, light.y),
                                    .phi_o = std::atan2(1.0, 0.0)});
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean.color[c] / (s[c] * double(c + 1)), 1, 0.02 + 4 * mean.error[c] / mean.color[c]) << c;
  }
}

TEST_P(OneFibre, EvenSurroundings_MeanIsTheAlbedo) {
  TracedScene scene = one_fibre(GetParam().model, GetParam().settings);
  const glm::dvec3 albedo = far_field(scene, bsdf::Quantity::albedo, {.theta_o = 0, .phi_o = std::numbers::pi / 2});
  for (const bool drawn : {false, true}) {
    scene.surroundings = white(drawn);
    const Mean mean = mean_where_covered(picture_of(scene, {}, {.samples = 64}));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.color[c], albedo[c], 0.003 + 4 * mean.error[c]) << c << drawn;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, OneFibre,
                         testing::Values(ModelCase{"chiang", "sigma_a=0.1/0.3/0.9,beta_m=0.3,beta_n=0.3,alpha=-0.05"},
                                         ModelCase{"marschner", "sigma_a=0.1/0.3/0.9"}, ModelCase{"kajiya_kay", ""}));

/// The fibre's width fills the picture, seen from so far away that rays are parallel.
TracedScene seen_from_afar(const TracedScene& near) {
  TracedScene scene = near;
  scene.camera.position = {0, 0, 1000};
  scene.camera.vertical_field_of_view = 2e-5;
  scene.camera.resolution = {16, 16};
  return scene;
}

// `cuticle eval --quantity S` gives these values: bsdf::evaluate in double, of the far field.
TEST_P(OneFibre, LightsAllAround_IntensityIsThatOfTheModel) {
  TracedScene scene = seen_from_afar(one_fibre(GetParam().model, GetParam().settings));
  double squares = 0;
  int count = 0;
  for (const double theta : {-0.7, 0.0, 0.4})
    for (int k = 0; k < 12; ++k, ++count) {
      const double phi = (k + 0.3) * std::numbers::pi / 6;
      const glm::dvec3 light(std::sin(theta), std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi));
      scene.lights = {{.name = "key", .to_light = light, .irradiance = glm::dvec3(1)}};
      const Mean mean = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 64}));
      const double viewer = std::numbers::pi / 2;
      const glm::dvec3 s =
          far_field(scene, bsdf::Quantity::S, {.theta_i = theta, .theta_o = 0, .phi = viewer - phi, .phi_o = viewer});
      const double error = mean.error.y + 2e-4 * s.y, z = (mean.color.y - s.y) / error;
      EXPECT_LT(std::abs(z), 4.5) << theta << " " << phi << ": " << mean.color.y << " +- " << mean.error.y << ", "
                                  << s.y;
      squares += z * z;
    }
  EXPECT_LT(squares, 74.4) << count;  // chi-squared of 36: one run in ten thousand is above
}

}  // namespace
}  // namespace cuticle::render::reference::one_fibre_test
