// The longitudinal term against mpmath, and its energy. Labels: N11 G1 G7.
#include "bsdf/shared/longitudinal.glslh"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/quadrature.h"
#include "tests/support/csv_table.h"

namespace cuticle::bsdf::longitudinal_test {
namespace {

constexpr double pi = std::numbers::pi;

template <class Real>
double evaluate(double beta, double alpha, double theta_i, double theta_o) {
  const LongitudinalLobe<double> lobe = make_longitudinal_lobe(beta, 2 * alpha);
  const LongitudinalLobe<Real> narrowed{Real(lobe.inverse_variance), Real(lobe.norm), Real(lobe.sin_shift),
                                        Real(lobe.cos_shift)};
  const Real i = Real(theta_i), o = Real(theta_o);
  return double(longitudinal(narrowed, precise_sin(i), precise_cos(i), precise_sin(o), precise_cos(o)));
}

/// The largest error over the table, relative to the larger of the value and a millionth of the lobe's height; rows
/// with a width of at least `least_beta`.
template <class Real>
double worst_error(double least_beta) {
  double worst = 0;
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/bsdf/marschner/reference/longitudinal.csv")) {
    const double beta = row.number("beta"), truth = row.number("m");
    if (beta < least_beta) continue;
    const double value = evaluate<Real>(beta, row.number("alpha"), row.number("theta_i"), row.number("theta_o"));
    worst = std::max(worst, std::abs(value - truth) / std::max(truth, 1e-6 / beta));
  }
  return worst;
}

TEST(Longitudinal, Double_AgreesWithMpmath) { EXPECT_LE(worst_error<double>(0), 1e-12); }
TEST(Longitudinal, Float_AgreesWithMpmathAtUsualWidths) { EXPECT_LE(worst_error<float>(0.1), 4e-6); }
TEST(Longitudinal, FloatAtTheNarrowestWidth_LosesOnlyWhatItsAnglesLost) { EXPECT_LE(worst_error<float>(0), 5e-4); }

/// The integral of M cos(theta_i) over theta_i, split at the peak, which folds back past a pole.
double energy(double beta, double alpha, double theta_o) {
  const double peak = -std::asin(std::sin(theta_o - 2 * alpha));
  const auto f = [&](double theta_i) { return evaluate<double>(beta, alpha, theta_i, theta_o) * std::cos(theta_i); };
  const Tolerance tolerance{.absolute = 1e-10, .relative = 1e-10};
  const double low = std::max(-pi / 2, peak - 12 * beta), high = std::min(pi / 2, peak + 12 * beta);
  return integrate_adaptive(f, low, peak, tolerance).value + integrate_adaptive(f, peak, high, tolerance).value;
}

struct Direction {
  double beta, alpha, theta_o;
};
class LongitudinalEnergy : public testing::TestWithParam<Direction> {};
INSTANTIATE_TEST_SUITE_P(Directions, LongitudinalEnergy,
                         testing::Values(Direction{0.26, 0, 0}, Direction{0.26, -0.13, 0.7}, Direction{1, 0.17, -1.2},
                                         Direction{2, 0, 0.3}, Direction{0.02, -0.1, 1.55},
                                         Direction{0.26, -0.17, 1.5707}, Direction{5e-4, 0, 0.2},
                                         Direction{1e-3, 0, 1.5707963}, Direction{0.6, 0.17, -1.5707}));
TEST_P(LongitudinalEnergy, OverThetaI_IsOne) {
  EXPECT_NEAR(energy(GetParam().beta, GetParam().alpha, GetParam().theta_o), 1, 2e-9);
}

TEST(Longitudinal, WithoutTilt_IsReciprocal) {
  EXPECT_DOUBLE_EQ(evaluate<double>(0.2, 0, 0.3, -0.9), evaluate<double>(0.2, 0, -0.9, 0.3));
}

TEST(Longitudinal, PeakOfANarrowLobe_IsAtTheShiftedSpecularDirection) {
  const double at = evaluate<double>(0.01, -0.1, -0.2 - 0.3, 0.3);
  EXPECT_GT(at, 0.99 * 1 / (0.01 * std::sqrt(2 * pi)));
  EXPECT_LT(evaluate<double>(0.01, -0.1, -0.2 - 0.3 + 0.05, 0.3), 1e-4 * at);
}

}  // namespace
}  // namespace cuticle::bsdf::longitudinal_test
