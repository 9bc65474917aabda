// Derivatives through ceres::Jet against central differences of the same formulas in double.
// glm keeps components in unions, which cannot hold a Jet, unless it is told to name them x, y, z, w only.
#define GLM_FORCE_XYZW_ONLY
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "bsdf/marschner/marschner.glslh"

namespace cuticle::bsdf::marschner::marschner_jet_test {
namespace {

template <class Real>
Real evaluate_with(const Real& eta, const Real& sigma_a, const Real& beta, const Real& alpha, int quantity, int lobe,
                   double phi) {
  const EvaluationPoint<Real> at{Real(0.2), Real(-0.1), Real(0.5), Real(phi), Real(0.4), Real(0)};
  return evaluate(make_marschner<Real>(eta, glm::vec<3, Real>(sigma_a), beta, alpha), quantity, lobe, at).x;
}

struct Place {
  int quantity, lobe;
  double phi;
};
class MarschnerJet : public testing::TestWithParam<Place> {};
INSTANTIATE_TEST_SUITE_P(Places, MarschnerJet,
                         testing::Values(Place{CUTICLE_QUANTITY_S, -1, 0.1}, Place{CUTICLE_QUANTITY_S, 0, 2.0},
                                         Place{CUTICLE_QUANTITY_S, 1, 3.0}, Place{CUTICLE_QUANTITY_N, 2, 0.05},
                                         Place{CUTICLE_QUANTITY_N, 2, 0.3}, Place{CUTICLE_QUANTITY_A, 2, 0},
                                         Place{CUTICLE_QUANTITY_M, 1, 0}));

TEST_P(MarschnerJet, Derivatives_AgreeWithCentralDifferences) {
  using Jet = ceres::Jet<double, 4>;
  const Place place = GetParam();
  const double start[4] = {1.5, 0.3, 0.25, -0.1};
  const Jet value = evaluate_with(Jet(start[0], 0), Jet(start[1], 1), Jet(start[2], 2), Jet(start[3], 3),
                                  place.quantity, place.lobe, place.phi);
  for (int k = 0; k < 4; ++k) {
    double low[4], high[4];
    for (int i = 0; i < 4; ++i) {
      low[i] = start[i] - (i == k ? 1e-5 : 0);
      high[i] = start[i] + (i == k ? 1e-5 : 0);
    }
    const double difference =
        (evaluate_with(high[0], high[1], high[2], high[3], place.quantity, place.lobe, place.phi) -
         evaluate_with(low[0], low[1], low[2], low[3], place.quantity, place.lobe, place.phi)) /
        2e-5;
    EXPECT_NEAR(value.v[k], difference, 2e-7 * (std::abs(value.a) + std::abs(difference))) << "parameter " << k;
  }
}

}  // namespace
}  // namespace cuticle::bsdf::marschner::marschner_jet_test
