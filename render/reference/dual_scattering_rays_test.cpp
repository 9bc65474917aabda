// Dual scattering with fibres counted along rays, in the place of paths.
#include "render/reference/dual_scattering.h"

#include <algorithm>
#include <numbers>

#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::dual_scattering_rays_test {
namespace {

using std::numbers::pi;

constexpr const char* k_brown = "sigma_a=0.3/0.6/1.2,beta_m=0.3,beta_n=0.3,alpha=0.03,field=near";

/// One fibre along x, lit from above, `blockers` more of them between it and the light, steeper each.
TracedScene fibre_behind(int blockers) {
  TracedScene scene = one_fibre("chiang", k_brown);
  scene.lights = {{.name = "key", .to_light = {0, 1, 0}, .irradiance = {1, 2, 3}}};
  for (int k = 0; k < blockers; ++k) {
    const glm::vec3 middle(0, 0.2f * float(k + 1), 0), along(1, 0.3f * float(k), 0);
    for (const float end : {-1.f, 1.f}) scene.hair.positions.push_back(middle + end * along);
    for (int end = 0; end < 2; ++end) scene.hair.radii.push_back(0.05f);
    scene.hair.offsets.push_back(std::uint32_t(scene.hair.positions.size()));
  }
  return scene;
}

Mean light_of(const TracedScene& scene, const TraceOptions& options, int samples = 64) {
  return mean_where_covered(picture_of(scene, options, {.samples = samples}));
}

double gaussian(double x, double variance) { return std::exp(-x * x / (2 * variance)) / std::sqrt(2 * pi * variance); }

// What the paper's equations give of averages at the very angles: no table, no shared formula.
glm::dvec3 expected_onward(const TracedScene& scene, const DualScatteringInstead& choice) {
  const auto average = [&](double theta) {
    return bsdf::average_scattering(*scene.model, scene.values, theta).value();
  };
  const double bent = choice.direction_spread * choice.direction_spread;
  glm::dvec3 share(1), spread(0), light(0);
  for (std::size_t s = 1; s < scene.hair.strand_count(); ++s) {
    const glm::vec3* ends = scene.hair.positions.data() + scene.hair.offsets[s];
    const bsdf::HalfScattering forward = average(std::asin(double(glm::normalize(ends[1] - ends[0]).y))).forward;
    share *= forward.share;
    spread += forward.deviation * forward.deviation + bent;
  }
  const bsdf::AverageScattering local = average(0);
  for (int c = 0; c < 3; ++c)
    for (const bsdf::HalfScattering& half : {local.forward, local.backward})  // phi is pi / 2: as much of each
      light[c] += scene.lights[0].irradiance[c] * choice.forward_density * share[c] * half.share[c] / 2 / pi *
                  gaussian(half.shift[c], half.deviation[c] * half.deviation[c] + spread[c]);
  return light;
}

TEST(DualScattering, FibreBehindOthers_HasWhatTheySendOn) {
  for (const int blockers : {1, 2, 3}) {
    TracedScene scene = fibre_behind(blockers);
    const DualScatteringInstead choice{.forward_density = 0.7, .backward_density = 0, .direction_spread = 0.2};
    const glm::dvec3 expected = expected_onward(scene, choice);
    const Mean mean = light_of(scene, {.dual_scattering = choice});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.color[c] / expected[c], 1, 5e-3) << blockers << ' ' << c;
  }
}

TEST(DualScattering, LoneFibreWithoutBackscattering_IsDirectLight) {
  const TracedScene scene = fibre_behind(0);
  const Mean direct = light_of(scene, {.scatterings = 1});
  EXPECT_EQ(direct.color, light_of(scene, {.dual_scattering = DualScatteringInstead{.backward_density = 0}}).color);
}

// A_b over pi by the Gaussian of its shift, half of it before the fibre.
TEST(DualScattering, LoneFibre_HasBackscatteringBesideDirectLight) {
  const TracedScene scene = fibre_behind(0);
  const glm::dvec3 direct = light_of(scene, {.scatterings = 1}).color;
  const glm::dvec3 both = light_of(scene, {.dual_scattering = DualScatteringInstead{.direction_spread = 0}}).color;
  const auto average = bsdf::average_scattering(*scene.model, scene.values, 0).value();
  const auto multiple = bsdf::multiple_backscattering(average).value();
  for (int c = 0; c < 3; ++c) {
    const double expected = scene.lights[0].irradiance[c] * multiple.attenuation[c] / 2 / pi *
                            gaussian(multiple.shift[c], multiple.deviation[c] * multiple.deviation[c]);
    EXPECT_NEAR((both - direct)[c] / expected, 1, 8e-3) << c;
  }
}

TEST(DualScattering, SurfaceBeforeOrBehindOtherFibres_LeavesNothing) {
  for (const float height : {0.1f, 0.3f}) {
    TracedScene scene = fibre_behind(1);
    Surface roof;
    roof.mesh.positions = {{-2, height, -1}, {2, height, -1}, {-2, height, 1}, {2, height, 1}};
    roof.mesh.normals.assign(4, glm::vec3(0, -1, 0));
    roof.mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    roof.albedo.assign(4, glm::vec3(0));
    scene.surfaces = {roof};
    EXPECT_EQ(light_of(scene, {.dual_scattering = DualScatteringInstead{}}, 8).color, glm::dvec3(0)) << height;
  }
}

TEST(DualScattering, FibreBehindAPointLight_IsNotOnTheWay) {
  TracedScene scene = fibre_behind(1);
  const PointLight lamp{.position = {0, 0.1, 0}, .intensity = {1, 1, 1}};
  scene.lights = {{.name = "lamp", .irradiance = {0, 0, 0}, .point_light = lamp}};
  const TraceOptions options{.dual_scattering = DualScatteringInstead{.backward_density = 0}};
  EXPECT_EQ(light_of(scene, {.scatterings = 1}, 8).color, light_of(scene, options, 8).color);
}

// Directions of the surroundings are drawn evenly there, the model's own where paths are traced.
TEST(DualScattering, EvenSurroundings_LightAloneFibreAsPathsDo) {
  TracedScene scene = one_fibre("chiang", k_brown);
  scene.surroundings = white(false);
  const Mean paths = light_of(scene, {.scatterings = 1}, 512);
  const Mean dual = light_of(scene, {.dual_scattering = DualScatteringInstead{.backward_density = 0}}, 2048);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(dual.color[c], paths.color[c], 4 * std::hypot(dual.error[c], paths.error[c])) << c;
}

// Layers sum to the whole, and are what the words say.
TEST(DualScattering, Layers_TellLightSentOnAndSentBack) {
  const TracedScene scene = fibre_behind(2);
  const TraceOptions options{.layers = true, .dual_scattering = DualScatteringInstead{}};
  const Picture picture = picture_of(scene, options, {.samples = 4});
  const auto sum_of = [&](const std::string& layer) {
    const auto& names = picture.layers.channel_names;
    const auto found = std::ranges::find(names, layer + ".G");
    EXPECT_NE(found, names.end()) << layer;
    double sum = 0;
    for (auto k = std::size_t(found - names.begin()); k < picture.layers.pixels.size();
         k += std::size_t(picture.layers.channels()))
      sum += double(picture.layers.pixels[k]);
    return sum;
  };
  double whole = 0;
  for (std::size_t k = 1; k < picture.color.pixels.size(); k += std::size_t(picture.color.channels()))
    whole += double(picture.color.pixels[k]);
  EXPECT_EQ(sum_of("single"), 0);
  EXPECT_GT(sum_of("multiple_forward"), sum_of("multiple_backward"));
  EXPECT_NEAR((sum_of("multiple_forward") + sum_of("multiple_backward")) / whole, 1, 1e-5);
  EXPECT_NEAR(sum_of("scatterings_3") / sum_of("multiple_forward"), 1, 1e-5);
}

// A ball of a thousand fibres: the terms alone, against every path. Measured: .97, 1.02, 1.02.
TEST(DualScattering, BallOfBrownHair_IsNearAllPaths) {
  TracedScene scene = lit_ball();
  scene.values = bsdf::parse_settings(*scene.model, "", "sigma_a=0.5/1/2,beta_m=0.3,beta_n=0.3,alpha=0").value();
  const Mean all = light_of(scene, {}, 64), dual = light_of(scene, {.dual_scattering = DualScatteringInstead{}}, 16);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(dual.color[c] / all.color[c], 1, 0.04) << c;
}

// Of fibres met at random, five in the mean: Poisson's sum over their number. The method's formula spreads light as
// much as the mean number of scatterings does, by which it differs (.91 to .96).
TEST(DualScattering, ByAShadowMethod_IsNearTheSumOverNumbersOfFibres) {
  const TracedScene scene = fibre_behind(0);
  const DualScattering dual = DualScattering::make(*scene.model, scene.values, {}).value();
  const FibreAngles angles{.theta_i = 0.2, .theta_o = -0.1, .away = 0.4};
  const double mean = 5;
  glm::dvec3 sum(0);
  FibresPassed passed;
  double chance = std::exp(-mean);
  for (int n = 0; n < 60; ++n, chance *= mean / n, dual.pass_fibre(std::sin(0.2), passed)) {
    const MultipleLight light = dual.light_after(passed, angles);
    sum += chance * (light.onward + light.back);
  }
  const MultipleLight light = dual.light_after(glm::dvec3(std::exp(-mean)), angles);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR((light.onward + light.back)[c] / sum[c], 0.94, 0.04) << c;
}

// Where a method stands in the place of rays, what it lets arrive is all that is read.
TEST(DualScattering, WithAShadowMethodThatBlocksNothing_OthersSendNothingOn) {
  TracedScene scene = fibre_behind(2);
  ShadowsInstead none;
  none.method = "none";
  const TraceOptions options{.shadows = none, .dual_scattering = DualScatteringInstead{}};
  EXPECT_EQ(light_of(fibre_behind(0), options, 8).color, light_of(scene, options, 8).color);
}

}  // namespace
}  // namespace cuticle::render::reference::dual_scattering_rays_test
