// Rays through a cross-section against what is known in closed form.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "viz/lobes/paths.h"

namespace cuticle::viz::paths_test {
namespace {

/// phi = 2 p gamma_t - 2 gamma_i + p pi (Marschner et al. 2003, equation 3), brought to -pi .. pi.
double circle_azimuth(int p, double h, double index) {
  const double phi = 2 * p * std::asin(h / index) - 2 * std::asin(h) + p * std::numbers::pi;
  return std::remainder(phi, 2 * std::numbers::pi);
}

TEST(TraceSection, Circle_LeavesWhereTheClosedFormSays) {
  for (const double theta : {0.0, 0.7})
    for (const double h : {-0.95, -0.4, 0.1, 0.8}) {
      const SectionPath path = trace_section({.theta = theta}, h);
      for (int p = 0; p < 3; ++p)
        EXPECT_NEAR(std::abs(std::remainder(
                        std::abs(path.phi[std::size_t(p)]) - std::abs(circle_azimuth(p, h, bravais_index(1.55, theta))),
                        2 * std::numbers::pi)),
                    0, 1e-9)
            << p << " " << h;
    }
}

TEST(TraceSection, Shares_AreAtMostTheLight) {
  for (const double h : {-0.99, 0.0, 0.5}) {
    const SectionPath path = trace_section({.aspect = 0.7, .turned = 0.4}, h);
    EXPECT_LE(path.share[0] + path.share[1] + path.share[2], 1 + 1e-12);
    EXPECT_GT(path.share[1], 0);
  }
}

TEST(TraceSection, Ellipse_KeepsUnitDirections) {
  const SectionPath path = trace_section({.aspect = 1.6, .turned = 0.5}, 0.3);
  EXPECT_NEAR(glm::length(path.leaves[0]), 1, 1e-12);
  EXPECT_NEAR(glm::length(path.leaves[1]), 1, 1e-12);
}

TEST(CausticOffset, Circle_IsTheClosedForm) {
  const double index = bravais_index(1.55, 0.3);
  EXPECT_NEAR(caustic_offset({.theta = 0.3}), std::sqrt((4 - index * index) / 3), 1e-3);
}

TEST(CausticOffset, IndexAboveTwo_HasNone) { EXPECT_LT(caustic_offset({.eta = 2.4}), 0); }

}  // namespace
}  // namespace cuticle::viz::paths_test
