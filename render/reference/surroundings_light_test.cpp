// Directions drawn from a picture of the surroundings.
#include "render/reference/surroundings_light.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "scene/environment.h"

namespace cuticle::render::reference::surroundings_light_test {
namespace {

/// A gradient with a sun.
Surroundings sky() {
  Surroundings surroundings{make_image(32, 16, {"R", "G", "B"}), 40, 0.5};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c) surroundings.picture.at(x, y, c) = 0.1f * float(c + 1) + 0.02f * float(16 - y);
  for (int c = 0; c < 3; ++c) surroundings.picture.at(20, 3, c) = 300;
  return surroundings;
}

TEST(SurroundingsLight, Drawn_MeanOfRadianceOverDensityIsTheLightOfTheEnvironment) {
  const auto light = SurroundingsLight::make(sky()).value();
  const auto whole = scene::environment_lights(sky().picture, {.lights = 1, .turn_degrees = 40, .scale = 0.5}).value();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  glm::dvec3 sum(0), moment(0);
  constexpr int k_count = 200000;
  for (int i = 0; i < k_count; ++i) {
    const auto drawn = light.draw(unit(random), unit(random), unit(random));
    EXPECT_NEAR(glm::length(drawn.to_light), 1, 1e-12);
    sum += drawn.radiance / drawn.density / double(k_count);
    moment += drawn.radiance.y / drawn.density * drawn.to_light / double(k_count);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / whole[0].irradiance[c], 1, 0.01) << c;
  EXPECT_GT(glm::dot(glm::normalize(moment), whole[0].to_light), 0.9999);
}

TEST(SurroundingsLight, RadianceAndDensity_AreThoseOfWhatWasDrawn) {
  const auto light = SurroundingsLight::make(sky()).value();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const auto drawn = light.draw(unit(random), 0.01 + 0.98 * unit(random), 0.01 + 0.98 * unit(random));
    EXPECT_EQ(light.radiance(drawn.to_light), drawn.radiance);
    EXPECT_NEAR(light.density(drawn.to_light) / drawn.density, 1, 1e-9);
  }
}

TEST(SurroundingsLight, Density_IntegratesToOne) {
  const auto light = SurroundingsLight::make(sky()).value();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  double sum = 0;
  constexpr int k_count = 400000;
  for (int i = 0; i < k_count; ++i) {
    const double up = 2 * unit(random) - 1, turn = 2 * std::numbers::pi * unit(random), across = std::sqrt(1 - up * up);
    sum += light.density({across * std::cos(turn), up, across * std::sin(turn)}) * 4 * std::numbers::pi / k_count;
  }
  EXPECT_NEAR(sum, 1, 0.06);  // most of it is in one texel of 512
}

TEST(SurroundingsLight, BlackOrMisshapenPicture_IsRefused) {
  Surroundings black{make_image(4, 2, {"R", "G", "B"})}, square{make_image(2, 2, {"R", "G", "B"})};
  EXPECT_THAT(SurroundingsLight::make(black).error().message, testing::HasSubstr("must shine"));
  EXPECT_THAT(SurroundingsLight::make(square).error().message, testing::HasSubstr("twice as wide as high"));
}

}  // namespace
}  // namespace cuticle::render::reference::surroundings_light_test
