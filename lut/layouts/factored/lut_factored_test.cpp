// Factors of S against sums of products that are known, and against the models themselves.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lut/format.h"
#include "lut/layouts/factored/slices.h"

namespace cuticle::lut::factored::lut_factored_test {
namespace {

/// Three bumps along each side, each by itself somewhere, as lobes of a fibre are.
double bump(double x, double middle) { return std::exp(-80 * (x - middle) * (x - middle)); }
Matrix known_sum() {
  Matrix matrix{60, 45, {}};
  for (int r = 0; r < 60; ++r)
    for (int c = 0; c < 45; ++c)
      matrix.values.push_back(3 * bump(r / 59.0, 0.2) * bump(c / 44.0, 0.1) +
                              bump(r / 59.0, 0.5) * bump(c / 44.0, 0.6) + 0.2 * bump(r / 59.0, 0.9) * (0.3 + c / 44.0));
  return matrix;
}

TEST(NonnegativeFactors, SumOfThreeProducts_IsMet) {
  const Matrix matrix = known_sum();
  const Factors factors = nonnegative_factors(matrix, distinct_rows(matrix));
  double error = 0, signal = 0;
  for (std::size_t r = 0; r < matrix.rows; ++r)
    for (std::size_t c = 0; c < matrix.columns; ++c) {
      double sum = 0;
      for (int k = 0; k < k_lobes; ++k) sum += factors.left[k][r] * factors.right[k][c];
      error += std::pow(sum - matrix.row(r)[c], 2);
      signal += std::pow(matrix.row(r)[c], 2);
    }
  EXPECT_LT(std::sqrt(error / signal), 1e-3);
}

TEST(NonnegativeFactors, FewerProducts_LeaveNoNegativeOrUndefinedNumber) {
  Matrix matrix{2, 6, std::vector<double>(12, 0.5)};
  const Factors factors = nonnegative_factors(matrix, distinct_rows(matrix));
  for (const Lobes& side : {factors.left, factors.right})
    for (const std::vector<double>& lobe : side)
      for (double value : lobe) ASSERT_TRUE(value >= 0 && std::isfinite(value));
}

const Layout& layout() { return *find_layout("factored").value(); }
TableSet certified(const char* model_name, const char* settings, int size) {
  const bsdf::Model& model = *bsdf::find_model(model_name).value();
  const auto values = bsdf::parse_settings(model, "", settings).value();
  TableSet set = bake(model, values, layout(), size, silent_progress()).value();
  EXPECT_TRUE(certify(set, half_exr(), silent_progress()).ok());
  return set;
}
double relative_rms(const TableSet& set) { return set.scattering[1].rms / set.scattering[1].signal_rms; }

TEST(Factored, Marschner_IsWithinItsMeasuredError) {
  EXPECT_LT(relative_rms(certified("marschner", "sigma_a=0.1/0.2/0.4,beta_deg=20", 32)), 0.07);
}
TEST(Factored, ModelsWithoutMAndN_AreWithinTheirMeasuredErrors) {
  EXPECT_LT(relative_rms(certified("kajiya_kay", "", 32)), 0.03);
}

/// A model of walks is asked for a viewer's lights together; what its few paths leave is part of the error.
TEST(Factored, Huang_IsWithinItsMeasuredError) {
  const double error = relative_rms(certified("huang", "sigma_a=0.1/0.2/0.4,samples=128", 32));
  std::printf("huang: %.3f\n", error);
  EXPECT_LT(error, 0.1);
}

/// A model of which every point is an integral is asked in batches of float.
TEST(Factored, SliceOfAnIntegral_IsTheModelInDouble) {
  const bsdf::Model& model = *bsdf::find_model("yan_fur").value();
  Source source = cpu_source(model, bsdf::parse_settings(model, "", "").value());
  ASSERT_TRUE(source.at_many);
  const Matrix batch = slice(source, 16, 5).value();
  source.at_many = {};
  const Matrix exact = slice(source, 16, 5).value();
  double worst = 0;
  for (std::size_t i = 0; i < exact.values.size(); ++i)
    worst = std::max(worst, std::abs(batch.values[i] - exact.values[i]) / (exact.values[i] + 1e-3));
  std::printf("off by %.1e\n", worst);
  EXPECT_LT(worst, 2e-5);
}

TEST(Factored, NearField_IsRefusedWithTheReason) {
  const bsdf::Model& model = *bsdf::find_model("chiang").value();
  const auto result =
      bake(model, bsdf::parse_settings(model, "", "field=near").value(), layout(), 16, silent_progress());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, testing::HasSubstr("offset h"));
}

}  // namespace
}  // namespace cuticle::lut::factored::lut_factored_test
