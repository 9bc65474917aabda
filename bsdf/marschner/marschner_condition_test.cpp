// M, N and A of the corrected model over the whole domain against mpmath with 50 digits: within 16 eps (1 + kappa),
// kappa being the condition number with respect to the numbers that a batch stores.
#define GLM_FORCE_XYZW_ONLY
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bsdf/marschner/marschner.glslh"

#include "tests/support/condition_number.h"
#include "tests/support/csv_table.h"

namespace cuticle::bsdf::marschner::marschner_condition_test {
namespace {

double setting(const std::string& settings, const std::string& name) {
  return std::strtod(settings.c_str() + settings.find(name + "=") + name.size() + 1, nullptr);
}

Marschner<double> prepared_of(const std::string& settings) {
  return make_marschner<double>(setting(settings, "eta"), glm::dvec3(setting(settings, "sigma_a")),
                                setting(settings, "beta"), setting(settings, "alpha"));
}

/// What the lobe's M, N or A may reach: below a millionth of it nothing is promised.
double peak(const std::string& quantity, int lobe, const std::string& settings) {
  const double widths[] = {1, 0.5, 2};
  if (quantity == "M") return 1 / (widths[lobe] * setting(settings, "beta") * std::sqrt(2 * std::numbers::pi));
  return quantity == "N" ? 0.25 : 1;
}

int quantity_of(const std::string& name) {
  return name == "M" ? CUTICLE_QUANTITY_M : name == "N" ? CUTICLE_QUANTITY_N : CUTICLE_QUANTITY_A;
}

template <class Real>
double evaluate_narrowed(const Marschner<double>& prepared, int quantity, int lobe, const EvaluationPoint<double>& at) {
  const EvaluationPoint<Real> point{Real(at.theta_i), Real(at.theta_o), Real(at.theta_d),
                                    Real(at.phi),     Real(at.h),       Real(at.phi_o)};
  return double(evaluate(narrow<Real>(prepared), quantity, lobe, point).x);
}

struct Worst {
  double over_allowed = 0, error = 0, kappa = 0;
  int rows = 0, plain = 0;  ///< rows compared; those whose kappa allows 1e-5 (float) or 1e-12 (double)
  std::string where;
};

template <class Real>
Worst worst_of(const std::string& quantity) {
  Worst worst;
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/bsdf/marschner/reference/domain.csv")) {
    const int lobe = int(row.number("lobe"));
    const std::string settings = row.text("settings");
    const double truth = row.number("value");
    if (row.text("quantity") != quantity || truth < 1e-6 * peak(quantity, lobe, settings)) continue;
    const Marschner<double> prepared = prepared_of(settings);
    const EvaluationPoint<double> at{row.number("theta_i"), row.number("theta_o"), row.number("theta_d"),
                                     row.number("phi"),     row.number("h"),       row.number("phi_o")};
    const auto call = [](const auto& p, int q, int l, const auto& x) { return evaluate(p, q, l, x); };
    const double kappa = tests::condition_number(prepared, quantity_of(quantity), lobe, at, call).kappa;
    const double allowed = tests::allowed_error<Real>(kappa);
    const double error = std::abs(evaluate_narrowed<Real>(prepared, quantity_of(quantity), lobe, at) - truth) / truth;
    ++worst.rows;
    worst.plain += allowed <= (sizeof(Real) == 4 ? 1e-5 : 1e-12);
    if (error / allowed <= worst.over_allowed) continue;
    worst = {error / allowed, error, kappa, worst.rows, worst.plain, settings + " lobe " + row.text("lobe")};
  }
  return worst;
}

template <class Real>
void expect_within_condition(const std::string& quantity) {
  const Worst worst = worst_of<Real>(quantity);
  EXPECT_GT(worst.rows, 60);
  EXPECT_LE(worst.over_allowed, 1) << quantity << " error " << worst.error << " kappa " << worst.kappa << " at "
                                   << worst.where;
  testing::Test::RecordProperty(quantity + "_worst_error_over_allowed", std::to_string(worst.over_allowed));
  testing::Test::RecordProperty(quantity + "_rows_of_low_condition", worst.plain);
}

class MarschnerCondition : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Quantities, MarschnerCondition, testing::Values("M", "N", "A"));
TEST_P(MarschnerCondition, FloatOverTheDomain_IsWithinItsConditionNumber) {
  expect_within_condition<float>(GetParam());
}
TEST_P(MarschnerCondition, DoubleOverTheDomain_IsWithinItsConditionNumber) {
  expect_within_condition<double>(GetParam());
}

}  // namespace
}  // namespace cuticle::bsdf::marschner::marschner_condition_test
