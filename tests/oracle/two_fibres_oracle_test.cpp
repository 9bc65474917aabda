// The path tracer against a walk between two parallel fibres that shares no code with it.
#include <numbers>

#include "render/reference/test_scenes.h"
#include "study/oracle/two_fibres.h"

namespace cuticle::tests::two_fibres {
namespace {

using namespace render::reference;
using study::oracle::OracleLight;

constexpr double k_radius = 0.1, k_distance = 0.3;
constexpr study::oracle::TwoFibres k_fibres{.radius = k_radius, .distance = k_distance, .coefficient = 0.09};

/// Along x, a hundred radii long, seen from afar along z across both.
TracedScene traced_fibres(const OracleLight& light) {
  TracedScene scene = scene_of("kajiya_kay", "diffuse=0.09,specular=0");
  for (const float y : {0.0f, float(k_distance)})
    for (const float x : {-5.0f, -2.5f, 0.0f, 2.5f, 5.0f}) scene.hair.positions.emplace_back(x, y, 0);
  scene.hair.radii.assign(10, float(k_radius));
  scene.hair.offsets = {0, 5, 10};
  scene.lights = {{.name = "sun",
                   .to_light = {std::sin(light.theta), std::cos(light.theta) * std::cos(light.phi),
                                std::cos(light.theta) * std::sin(light.phi)},
                   .irradiance = glm::dvec3(1)}};
  scene.camera.position = {0, k_distance / 2, 1000};
  scene.camera.target = {0, k_distance / 2, 0};
  scene.camera.vertical_field_of_view = 0.52e-3;
  scene.camera.resolution = {16, 104};
  return scene;
}

class TwoFibresTraced : public testing::TestWithParam<OracleLight> {};

TEST_P(TwoFibresTraced, AnyNumberOfScatterings_RadianceIsThatOfTheWalk) {
  const TracedScene scene = traced_fibres(GetParam());
  for (const int scatterings : {1, 2, 0}) {
    const Mean traced = mean_where_covered(picture_of(scene, {.scatterings = scatterings}, {.samples = 64}));
    const auto walked = study::oracle::seen_radiance(k_fibres, GetParam(), scatterings, 400000, 7);
    // The light that scatters once has no noise: the model is evaluated in float.
    const double error = std::hypot(traced.error.x, walked.standard_error, 1e-5 * walked.mean);
    EXPECT_NEAR((traced.color.x - walked.mean) / error, 0, 3.5)
        << scatterings << ": " << traced.color.x << " +- " << traced.error.x << ", walk " << walked.mean;
    EXPECT_LT(error, 0.006 * walked.mean);
  }
}

INSTANTIATE_TEST_SUITE_P(Lights, TwoFibresTraced,
                         testing::Values(OracleLight{0.3, 0.4}, OracleLight{-0.6, 1.2}, OracleLight{0, 2.9},
                                         OracleLight{0.2, -1.0}));

}  // namespace
}  // namespace cuticle::tests::two_fibres
