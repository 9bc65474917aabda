// Two fibres of which something is known without a walk.
#include "study/oracle/two_fibres.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace cuticle::study::oracle::two_fibres_test {
namespace {

// Light along the view: nothing is hidden, and one scattering is the law itself.
TEST(TwoFibres, LightBesideTheViewer_OneScatteringIsTheLaw) {
  const SeenRadiance seen = seen_radiance({}, {.theta = 0.4, .phi = std::numbers::pi / 2}, 1, 1000, 1);
  EXPECT_NEAR(seen.mean, 0.09 * std::cos(0.4), 1e-12);
}

// From the side the near fibre lies wholly in the other's shadow.
TEST(TwoFibres, LightAlongTheirPlane_OneIsDark) {
  const SeenRadiance seen = seen_radiance({}, {.theta = 0, .phi = 0}, 1, 1000, 1);
  EXPECT_NEAR(seen.mean, 0.09 / 2, 1e-12);
}

// The share of azimuths in which the other fibre lies is about 2 r / (2 pi d) where it is far away.
TEST(TwoFibres, FarApart_SecondScatteringIsTheShareOfAzimuths) {
  const TwoFibres fibres{.radius = 1, .distance = 100, .coefficient = 0.09};
  const OracleLight light{.theta = 0, .phi = std::numbers::pi / 2};
  const SeenRadiance once = seen_radiance(fibres, light, 1, 400000, 1),
                     twice = seen_radiance(fibres, light, 2, 400000, 1);
  const double share = 1 / (std::numbers::pi * 100), albedo = std::numbers::pi * std::numbers::pi * 0.09;
  EXPECT_NEAR((twice.mean - once.mean) / (0.09 * albedo * share), 1, 4 / std::sqrt(400000 * share));
}

}  // namespace
}  // namespace cuticle::study::oracle::two_fibres_test
