// A clear fibre under an even sky, for every model that claims to keep all of the light: S over the sphere is 1 at each
// inclination, by even directions, without the models' samplers.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/model_values.h"

namespace cuticle::white_furnace_test {
namespace {

constexpr double k_pi = std::numbers::pi;

struct Fibre {
  const char *model, *settings;
  int thetas, phis;
  double bound;
};

/// The share of an even sky that is scattered to a viewer at theta_o.
double scattered(const Fibre& fibre, double theta_o) {
  std::vector<bsdf::Point> points;
  for (int i = 0; i < fibre.thetas; ++i)
    for (int k = 0; k < fibre.phis; ++k)
      points.push_back({.theta_i = ((i + 0.5) / fibre.thetas - 0.5) * k_pi,
                        .theta_o = theta_o,
                        .phi = ((k + 0.5) / fibre.phis - 0.5) * 2 * k_pi});
  const auto values = tests::ValuesOf{fibre.model}(fibre.settings, bsdf::Quantity::S, -1, points);
  double sum = 0;
  for (std::size_t n = 0; n < points.size(); ++n) sum += values[n].x * std::cos(points[n].theta_i);
  return sum * (k_pi / fibre.thetas) * (2 * k_pi / fibre.phis);
}

class WhiteFurnace : public testing::TestWithParam<Fibre> {};

TEST_P(WhiteFurnace, ClearFibre_ScattersAllThatItGetsAtFiveInclinations) {
  const Fibre& fibre = GetParam();
  for (double degrees : {-75.0, -40.0, 0.0, 30.0, 60.0})
    EXPECT_NEAR(scattered(fibre, degrees * k_pi / 180), 1, fibre.bound) << fibre.settings << " " << degrees;
}
INSTANTIATE_TEST_SUITE_P(
    Models, WhiteFurnace,
    testing::Values(Fibre{"deon", "sigma_a=0,beta_m=0.4,beta_n=0.3,alpha_deg=-2", 96, 48, 1e-3},
                    Fibre{"chiang", "sigma_a=0,beta_m=0.4,beta_n=0.4,alpha_deg=2,field=far", 96, 48, 1e-3},
                    Fibre{"yan_fur", "sigma_a=0,sigma_ma=0", 48, 48, 5e-4},
                    Fibre{"huang", "sigma_a=0,roughness=0.4,samples=256", 24, 32, 0.03}),
    [](const auto& info) { return info.param.model; });

}  // namespace
}  // namespace cuticle::white_furnace_test
