// Directions drawn by the Chiang model against its own density and energy.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "core/random.h"

namespace cuticle::bsdf::chiang_sampling_test {
namespace {

constexpr double pi = std::numbers::pi;
const Model& model() { return **find_model("chiang"); }

struct Case {
  const char* settings;
  double theta_o, h;
  int count;
};

std::vector<Sample> draw(const Case& c, Precision precision) {
  RandomStream random(2016);
  std::vector<SampleQuery> queries(std::size_t(c.count), {.theta_o = c.theta_o, .h = c.h});
  for (SampleQuery& query : queries)
    for (double& u : query.u) u = random.next_unit();
  std::vector<Sample> samples(queries.size());
  EXPECT_TRUE(sample(model(), *parse_settings(model(), "", c.settings), precision, queries, samples).ok());
  return samples;
}
std::vector<glm::dvec3> values_at(const Case& c, Quantity quantity, const std::vector<Point>& points) {
  std::vector<glm::dvec3> out(points.size());
  EXPECT_TRUE(
      evaluate(model(), *parse_settings(model(), "", c.settings), Precision::f64, {quantity, -1, points}, out).ok());
  return out;
}

class ChiangSampler : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Cases, ChiangSampler,
    testing::Values(Case{"field=near,beta_m=0.3,beta_n=0.3,alpha=0.1,sigma_a=0.1/0.5/1", 0.5, 0.4, 80000},
                    Case{"field=near,beta_m=1,beta_n=1,alpha=-0.17,sigma_a=0", -1.5, -0.95, 80000},
                    Case{"field=near,beta_m=0.15,beta_n=0.2,sigma_a=2", 0, 0, 80000},
                    Case{"field=near,beta_m=0.6,beta_n=0.6,eta=1.1,sigma_a=0.01", 1.57, 0.5, 80000},
                    Case{"field=far,beta_m=0.4,beta_n=0.5,tolerance=1e-3", 0.3, 0, 6000},
                    Case{"field=far,beta_m=0.4,beta_n=0.5,h_from=0.2,h_to=0.9,tolerance=1e-3", 0.3, 0, 6000}));

TEST_P(ChiangSampler, MeanOfTheWeights_IsTheAlbedo) {
  const glm::dvec3 albedo =
      values_at(GetParam(), Quantity::albedo, {{.theta_o = GetParam().theta_o, .h = GetParam().h}})[0];
  for (const Precision precision : {Precision::f32, Precision::f64}) {
    glm::dvec3 sum(0), squares(0);
    for (const Sample& s : draw(GetParam(), precision)) {
      ASSERT_TRUE(std::isfinite(s.weight.x) && s.pdf >= 0);
      sum += s.weight;
      squares += s.weight * s.weight;
    }
    const double n = GetParam().count;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[c] / n, albedo[c],
                  4.5 * std::sqrt(std::max(squares[c] / n - sum[c] / n * sum[c] / n, 0.0) / n) + 1e-4)
          << c;
  }
}

constexpr int rows = 12, columns = 16, inner = 24;

/// The chance of each cell of equal steps in sin theta_i and phi, by midpoints of the pdf.
std::vector<double> expected_chances(const Case& c, int steps) {
  std::vector<double> chances(std::size_t(rows * columns), 0);
  std::vector<Point> points;
  for (int i = 0; i < rows * steps; ++i)
    for (int k = 0; k < columns * steps; ++k)
      points.push_back({.theta_i = std::asin((i + 0.5) / (rows * steps) * 2 - 1),
                        .theta_o = c.theta_o,
                        .phi = ((k + 0.5) / (columns * steps) * 2 - 1) * pi,
                        .h = c.h});
  const auto density = values_at(c, Quantity::pdf, points);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const std::size_t row = n / std::size_t(columns * steps) / std::size_t(steps),
                      column = n % std::size_t(columns * steps) / std::size_t(steps);
    chances[row * columns + column] += density[n].x * 4 * pi / double(points.size());
  }
  return chances;
}

// Chi-square over cells that expect at least 10; 5.5 standard deviations of the statistic.
TEST_P(ChiangSampler, Histogram_FollowsTheDensity) {
  const bool far = GetParam().count < 10000;
  const std::vector<double> chances = expected_chances(GetParam(), far ? 4 : inner);
  std::vector<double> counts(chances.size(), 0);
  for (const Sample& s : draw(GetParam(), Precision::f64)) {
    const int row = std::clamp(int((std::sin(s.theta_i) + 1) / 2 * rows), 0, rows - 1);
    const int column = std::clamp(int((s.phi / pi + 1) / 2 * columns), 0, columns - 1);
    counts[std::size_t(row * columns + column)] += 1;
  }
  double statistic = 0, cells = 0;
  for (std::size_t i = 0; i < chances.size(); ++i) {
    const double expected = chances[i] * GetParam().count;
    if (expected < 10) continue;
    statistic += (counts[i] - expected) * (counts[i] - expected) / expected;
    cells += 1;
  }
  EXPECT_LT(statistic, cells + 5.5 * std::sqrt(2 * cells));
}

TEST(ChiangSampler, LobesDrawn_TakeTheirShares) {
  const Case c{"field=near,sigma_a=0.3", 0.4, 0.2, 60000};
  std::array<double, 4> counts{};
  for (const Sample& s : draw(c, Precision::f64)) counts[std::size_t(s.lobe)] += 1;
  double total = 0;
  std::array<double, 4> energy{};
  for (int lobe = 0; lobe < 4; ++lobe) {
    const Point point{.theta_o = c.theta_o, .h = c.h};
    glm::dvec3 albedo(0);
    ASSERT_TRUE(evaluate(model(), *parse_settings(model(), "", c.settings), Precision::f64,
                         {Quantity::albedo, lobe, {&point, 1}}, {&albedo, 1})
                    .ok());
    total += energy[std::size_t(lobe)] = albedo.x;
  }
  for (std::size_t lobe = 0; lobe < 4; ++lobe)
    EXPECT_NEAR(counts[lobe] / c.count, energy[lobe] / total, 4 * std::sqrt(energy[lobe] / total / c.count)) << lobe;
}

}  // namespace
}  // namespace cuticle::bsdf::chiang_sampling_test
