// Lights of a picture of the surroundings: all of its light, from where it shines.
#include "scene/environment.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::scene::environment_test {
namespace {

constexpr double k_pi = std::numbers::pi;

Image sky(float radiance) {
  Image picture = make_image(64, 32, {"R", "G", "B"});
  for (float& value : picture.pixels) value = radiance;
  return picture;
}

glm::dvec3 sum_of(const std::vector<Light>& lights) {
  glm::dvec3 sum(0);
  for (const Light& light : lights) sum += light.irradiance;
  return sum;
}

TEST(EnvironmentLights, EvenSky_HoldsAllItsLightAndHasNoSide) {
  const auto lights = environment_lights(sky(0.5f), {.lights = 8});
  ASSERT_TRUE(lights) << lights.error().message;
  ASSERT_EQ(lights->size(), 8u);
  glm::dvec3 pull(0);
  for (const Light& light : *lights) {
    EXPECT_NEAR(light.irradiance.x, 4 * k_pi * 0.5 / 8, 0.03);
    EXPECT_NEAR(glm::length(light.to_light), 1, 1e-12);
    pull += light.irradiance.x * light.to_light;
  }
  EXPECT_NEAR(sum_of(*lights).x, 4 * k_pi * 0.5, 1e-6);
  EXPECT_LT(glm::length(pull), 0.01);
}

// A sun in a faint sky: one light is the sun, where the sun stands.
TEST(EnvironmentLights, Sun_IsOneOfThem) {
  Image picture = sky(0.01f);
  const int x = 40, y = 9;
  for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 5000;
  const auto lights = environment_lights(picture, {.lights = 6, .scale = 2});
  ASSERT_TRUE(lights);
  const Light& sun = *std::ranges::max_element(*lights, {}, [](const Light& light) { return light.irradiance.x; });
  const double down = k_pi * (y + 0.5) / 32, right = 2 * k_pi * (x + 0.5) / 64 - k_pi;
  const glm::dvec3 there(-std::sin(right) * std::sin(down), std::cos(down), std::cos(right) * std::sin(down));
  EXPECT_GT(glm::dot(sun.to_light, there), 0.9999);
  EXPECT_NEAR(sun.irradiance.x, 2 * 5000 * 2 * k_pi / 64 * (std::cos(k_pi * y / 32) - std::cos(k_pi * (y + 1) / 32)),
              0.3);
}

TEST(EnvironmentLights, MiddleColumn_IsWhatTheFaceLooksAt_AndTurnsTowardsX) {
  Image picture = sky(0);
  for (int x = 31; x < 33; ++x)
    for (int c = 0; c < 3; ++c) picture.at(x, 15, c) = picture.at(x, 16, c) = 1;
  const auto ahead = environment_lights(picture, {.lights = 1});
  const auto turned = environment_lights(picture, {.lights = 1, .turn_degrees = 90});
  ASSERT_TRUE(ahead && turned);
  EXPECT_LT(glm::distance(ahead->at(0).to_light, glm::dvec3(0, 0, 1)), 1e-6);
  EXPECT_LT(glm::distance(turned->at(0).to_light, glm::dvec3(1, 0, 0)), 1e-6);
}

TEST(EnvironmentLights, BuiltInSky_LightsGroundFromAboveByItsStatedIrradiance) {
  const auto lights = environment_lights(built_in_sky(), {.lights = 8});
  ASSERT_TRUE(lights) << lights.error().message;
  double received = 0;
  for (const Light& light : *lights) received += light.irradiance.y * std::max(light.to_light.y, 0.0);
  EXPECT_NEAR(received, 2, 0.4);
}

TEST(EnvironmentLights, BlackPicture_HasNone_AndOneTexelOne) {
  Image picture = sky(0);
  EXPECT_TRUE(environment_lights(picture, {})->empty());
  picture.at(3, 3, 1) = 1;
  EXPECT_EQ(environment_lights(picture, {})->size(), 1u);
}

TEST(EnvironmentLights, BadPicture_IsRefusedByItsTexel) {
  Image picture = sky(1);
  picture.at(5, 7, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(environment_lights(picture, {}).error().message, testing::HasSubstr("(5, 7)"));
  EXPECT_THAT(environment_lights(make_image(64, 64, {"R", "G", "B"}), {}).error().message,
              testing::HasSubstr("64 x 64"));
}

}  // namespace
}  // namespace cuticle::scene::environment_test
