#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cuticle/shadows/light_frame.h>

using namespace cuticle;

TEST(LightFrame, AnyDirection_AxesAreRightHandedAndUnit) {
  for (const glm::dvec3 light : {glm::dvec3(0, 1, 0), {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0.6, -0.8, 0}, {1e-9, 0, -1}}) {
    const shadows::LightFrame frame = shadows::fit_light_frame({{-1, -1, -1}, {1, 1, 1}}, glm::normalize(light));
    EXPECT_NEAR(glm::length(glm::cross(frame.right, frame.up) - frame.forward), 0, 1e-12);
    EXPECT_NEAR(glm::dot(frame.right, frame.up), 0, 1e-12);
    EXPECT_NEAR(glm::length(frame.right), 1, 1e-12);
  }
}

TEST(LightFrame, BoxFromAbove_NearAndFarPlanesTouchIt) {
  const shadows::LightFrame frame = shadows::fit_light_frame({{-1, 2, -3}, {1, 5, 3}}, {0, 1, 0});
  EXPECT_NEAR(frame.near_z, -5, 1e-12);
  EXPECT_NEAR(frame.far_z, -2, 1e-3);
  EXPECT_NEAR(frame.width, 6, 1e-12);
}

TEST(LightFrame, OnePoint_HasAnExtent) {
  const shadows::LightFrame frame = shadows::fit_light_frame({{1, 1, 1}, {1, 1, 1}}, {0, 1, 0});
  EXPECT_GT(frame.width, 0);
  EXPECT_GT(frame.far_z, frame.near_z);
}

TEST(LightFrame, ZeroOrNotFiniteDirection_IsRefused) {
  EXPECT_FALSE(shadows::unit_to_light({0, 0, 0}));
  EXPECT_FALSE(shadows::unit_to_light({0, std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(shadows::unit_to_light({0, std::numeric_limits<double>::infinity(), 0}));
}
