// The adaptive rule of the shared dialect: polynomials, peaks, edges, and whether its error bounds the true one.
#include "bsdf/shared/adaptive_quadrature.glslh"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace cuticle::bsdf::adaptive_quadrature_test {
namespace {

template <class Real, class Function, class Hidden>
AdaptiveIntegral<Real> integrate(Real lower, Real upper, Real tolerance, const Function& function,
                                 const Hidden& hidden) {
  AdaptiveIntegral<Real> integral = start_integral(lower, upper);
  while (is_open(integral)) {
    Panel<Real> panel = empty_panel(lower);
    for (int k = 0; k < 15; ++k) panel = with_value(panel, k, glm::vec<3, Real>(function(panel_point(integral, k))));
    integral = settled(integral, panel, tolerance, hidden(panel_lower(integral), panel_upper(integral)));
  }
  return integral;
}
template <class Real, class Function>
AdaptiveIntegral<Real> integrate(Real lower, Real upper, Real tolerance, const Function& function) {
  return integrate(lower, upper, tolerance, function, [](Real, Real) { return false; });
}

TEST(AdaptiveQuadrature, PolynomialOfDegree22_IsExactByFifteenPoints) {
  double sum = 0, coarse = 0;
  for (int k = 0; k < 15; ++k) {
    const glm::dvec3 node = kronrod_node(1.0, k);
    sum += node.y * std::pow(node.x, 22);
    coarse += node.z * std::pow(node.x, 12);
  }
  EXPECT_NEAR(sum, 2.0 / 23, 1e-16);
  EXPECT_NEAR(coarse, 2.0 / 13, 2e-16);
}

TEST(AdaptiveQuadrature, SmoothIntegrand_TakesOnePanel) {
  const auto integral = integrate(0.0, 1.0, 1e-12, [](double x) { return std::exp(x); });
  EXPECT_EQ(integral.panels, 1);
  EXPECT_NEAR(integral.value.x, std::exp(1.0) - 1, 5e-16);
}

TEST(AdaptiveQuadrature, EmptyInterval_IsZero) {
  EXPECT_EQ(integrate(0.5, 0.5, 1e-12, [](double x) { return x; }).value.x, 0);
}

/// Lorentz peaks of random width and place: their integrals are arc tangents.
template <class Real>
int peaks_beyond_the_error(double narrowest, Real tolerance) {
  std::mt19937 random(7);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  int beyond = 0;
  for (int i = 0; i < 300; ++i) {
    const double width = std::pow(narrowest, uniform()), at = 2 * uniform() - 1;
    const Real w = Real(width), a = Real(at);
    const auto peak = [&](Real x) { return w / (w * w + (x - a) * (x - a)); };
    const auto hidden = [&](Real low, Real high) { return low - w < a && a < high + w && high - low > 8 * w; };
    const auto integral = integrate(Real(-1), Real(1), tolerance, peak, hidden);
    const double truth = std::atan((1 - double(a)) / double(w)) + std::atan((1 + double(a)) / double(w));
    if (std::abs(double(integral.value.x) - truth) > double(integral.error.x)) ++beyond;
    EXPECT_LE(double(integral.error.x), 3 * double(tolerance) * truth + 1e-6 * truth * (sizeof(Real) == 4));
  }
  return beyond;
}
TEST(AdaptiveQuadrature, ReportedErrorOfPeaks_BoundsTheTrueOneIn99Percent) {
  EXPECT_EQ(peaks_beyond_the_error<double>(1e-4, 1e-9), 0);
  EXPECT_LE(peaks_beyond_the_error<double>(1e-4, 1e-4), 1);
  EXPECT_EQ(peaks_beyond_the_error<float>(1e-2, 1e-5f), 0);
}

TEST(AdaptiveQuadrature, NarrowPeakBetweenThePoints_IsFoundWhenToldThatItHides) {
  const auto peak = [](double x) { return std::exp(-square((x - 0.3001) / 1e-5)); };
  const auto holds = [](double low, double high) { return low < 0.3001 && 0.3001 < high && high - low > 1e-4; };
  EXPECT_LT(integrate(-1.0, 1.0, 1e-9, peak).value.x, 1e-7);
  EXPECT_NEAR(integrate(-1.0, 1.0, 1e-9, peak, holds).value.x, 1e-5 * std::sqrt(std::acos(-1.0)), 1e-14);
}

TEST(AdaptiveQuadrature, ToleranceOutOfReach_EndsAndSaysSo) {
  const auto integral = integrate(0.0, 1.0, 0.0, [](double x) { return std::sin(1e5 * x); });
  EXPECT_LE(integral.panels, 600);
  EXPECT_GT(integral.error.x, 1e-4);
}

}  // namespace
}  // namespace cuticle::bsdf::adaptive_quadrature_test
