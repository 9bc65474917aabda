// What fitted texels gain, as tables: lut/fit/README.md quotes them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "lut/comparison.h"
#include "lut/fit/analytic_fit.h"
#include "lut/fit/texel_fit.h"

namespace cuticle::lut::lut_fit_gains_test {
namespace {

constexpr double k_degree = 0.017453292519943295;

TableSet baked(std::string_view name, const std::string& settings, std::string_view layout, int size) {
  const bsdf::Model& model = *bsdf::find_model(name).value();
  const auto values = registry::parse_assignments(model.entry.parameters, settings).value();
  return bake(model, values, *find_layout(layout).value(), size, silent_progress()).value();
}
TableSet only_table(TableSet set, std::size_t table) {
  set.tables = {set.tables[table]};
  return set;
}
TexelFit fitted(const TableSet& set, std::string_view format = "exr") {
  return fit_texels(set, *find_format(format).value(), silent_progress()).value();
}
double gain(const ChannelFit& channel) { return channel.unfitted.rms / channel.fitted.rms; }
double share(double part, double whole) { return 100 * part / whole; }
void print(std::string_view title, const TexelFit& fit) {
  fmt::print("{:<34}{:>12}{:>20}{:>7}{:>20}{:>20}\n", title, "channel", "rms %", "gain", "rms in angle %",
             "max % of peak");
  for (const auto& [name, a, b, kept] : fit.channels)
    fmt::print("{:<34}{:>12}{:>10.3f}{:>10.3f}{:>7.2f}{:>10.3f}{:>10.3f}{:>10.2f}{:>10.2f}{}\n", "", name,
               share(a.rms, a.signal_rms), share(b.rms, b.signal_rms), a.rms / b.rms,
               share(a.in_angle.rms, a.in_angle.signal_rms), share(b.in_angle.rms, b.in_angle.signal_rms),
               share(a.maximum, a.peak), share(b.maximum, b.peak), kept ? "" : "  samples kept");
}

/// Rows of the bilinear filter at five points a texel, written out anew, and the best texels of any sign.
double dense_optimum(const TableSet& set, int channel, const ExactValues& exact) {
  const int size = set.size, points = 5 * size;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size * size, size * size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size * size);
  double squares = 0;
  for (int i = 0; i < points * points; ++i) {
    const double x = std::clamp((i % points + 0.5) / 5 - 0.5, 0.0, size - 1.0);
    const double y = std::clamp((i / points + 0.5) / 5 - 0.5, 0.0, size - 1.0);
    const double value = exact.values[std::size_t(i)][set.tables[0].layout->channels[std::size_t(channel)].component];
    squares += value * value;
    std::vector<std::pair<int, double>> row;
    for (int t = 0; t < 4; ++t) {
      const int column = std::min(int(x), size - 2) + t % 2, line = std::min(int(y), size - 2) + t / 2;
      row.emplace_back(line * size + column, (1 - std::abs(x - column)) * (1 - std::abs(y - line)));
    }
    for (const auto& [a, weight] : row) {
      right[a] += weight * value;
      for (const auto& [b, other] : row) normal(a, b) += weight * other;
    }
  }
  const Eigen::VectorXd texels = normal.ldlt().solve(right);
  return std::sqrt((squares - right.dot(texels)) / (points * points));
}

double rms_on(const Table& table, int channel, const ComparisonGrid& grid, const ExactValues& exact) {
  double squares = 0;
  const int component = table.layout->channels[std::size_t(channel)].component;
  for (std::size_t i = 0; i < grid.size(); ++i)
    squares += std::pow(filtered_value(table, channel, grid, i) - exact.values[i][component], 2);
  return std::sqrt(squares / double(grid.size()));
}

/// How many times the optimum of any sign the fit leaves, at 32 x 32.
double over_optimum(std::size_t table, int c) {
  const TableSet set = only_table(baked("marschner", "", "nalu", 32), table);
  const TexelFit fit = fitted(set);
  const ComparisonGrid grid{5 * 32, 5 * 32};
  const Channel& channel = set.tables[0].layout->channels[std::size_t(c)];
  const ExactValues exact = exact_values(cpu_source(*set.model, set.values), channel, set.tables[0], grid).value();
  const double optimum = dense_optimum(set, c, exact), reached = rms_on(fit.set.tables[0], c, grid, exact);
  fmt::print("{:<12} optimum {:.4e}, fit {:.4e}: {:.4f} times it\n", channel.name, optimum, reached, reached / optimum);
  return reached / optimum;
}

TEST(FitTexels, At32_IsWithinTwoPercentOfTheUnconstrainedOptimum) {
  for (int c : {0, 2, 3}) EXPECT_LE(over_optimum(0, c), 1.002);
  EXPECT_LE(over_optimum(1, 0), 1.02) << "half rounds N_TT";
}

// On sine axes at 32, M_TT is narrower than a texel and its optimum has negative texels, which no texture format here
// holds.
TEST(FitTexels, WhereTheOptimumIsNegative_TheBoundCostsFivePercent) { EXPECT_LE(over_optimum(0, 1), 1.05); }

class FitOfM : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Widths, FitOfM, testing::Values(5.0, 10.0));

// In 16 bit: half's own rounding, 1.3e-4 of the value, is as large as what the fit of wide lobes leaves.
TEST_P(FitOfM, OnAngleAxes_GainsTwoAndAHalfTimes) {
  const TableSet set =
      only_table(baked("marschner", fmt::format("beta={}", 2 * GetParam() * k_degree), "nalu_theta", 128), 0);
  print(fmt::format("M, angles, half, {} degrees", GetParam()), fitted(set));
  const TexelFit fit = fitted(set, "png16");
  print(fmt::format("M, angles, 16 bit, {} degrees", GetParam()), fit);
  for (const ChannelFit& channel : fit.channels) {
    EXPECT_GE(gain(channel), 2.5) << channel.channel;
    EXPECT_LE(channel.fitted.rms, 0.0031 * channel.fitted.signal_rms) << channel.channel;
    EXPECT_LE(channel.fitted.maximum, 0.01 * channel.fitted.peak) << channel.channel;
  }
}

TEST_P(FitOfM, OnSineAxes_TheOptimumItselfGainsLittle) {
  const TableSet set =
      only_table(baked("marschner", fmt::format("beta={}", 2 * GetParam() * k_degree), "nalu", 128), 0);
  const TexelFit fit = fitted(set);
  print(fmt::format("M, sine axes, beta {} degrees", GetParam()), fit);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GE(gain(fit.channels[std::size_t(c)]), 1.25);
    EXPECT_LE(gain(fit.channels[std::size_t(c)]), 1.55);
  }
}

AnalyticFit analytic(std::string_view name, std::string_view settings) {
  const bsdf::Model& model = *bsdf::find_model(name).value();
  const auto values = registry::parse_assignments(model.entry.parameters, settings).value();
  const AnalyticFit fit = fit_analytic(model, values, silent_progress()).value();
  for (const AnalyticLobe& lobe : fit.lobes)
    fmt::print("{:<10}{:<5}N rms {:.2f} % max {:.2f} %, M rms {:.2f} % max {:.2f} %\n", name, lobe.name,
               100 * lobe.n.rms, 100 * lobe.n.maximum, 100 * lobe.m.rms, 100 * lobe.m.maximum);
  return fit;
}

TEST(FitAnalytic, RoughFibre_StaysWithinAFewPercent) {
  for (const AnalyticLobe& lobe : analytic("deon", "beta_n=0.3,azimuthal_tolerance=1e-4").lobes) {
    EXPECT_LE(lobe.n.rms, 0.033) << lobe.name;
    EXPECT_LE(lobe.m.rms, 0.037) << lobe.name;
  }
}

}  // namespace
}  // namespace cuticle::lut::lut_fit_gains_test
