#pragma once
// Samples of a model counted over bins of theta_i and phi, against what its density says of them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "core/quadrature.h"

namespace cuticle::tests {

/// A model with settings, seen from theta_o, at an offset (near field).
struct View {
  const bsdf::Model& model;
  std::string settings;
  double theta_o = 0, h = 0;
};

inline std::vector<double> values_at(const View& view, bsdf::Quantity quantity, int lobe,
                                     const std::vector<bsdf::Point>& points) {
  std::vector<glm::dvec3> out(points.size());
  EXPECT_TRUE(bsdf::evaluate(view.model, *bsdf::parse_settings(view.model, "", view.settings), bsdf::Precision::f64,
                             {quantity, lobe, points}, out)
                  .ok());
  std::vector<double> values;
  for (const glm::dvec3& value : out) values.push_back(value.x);
  return values;
}

/// Samples by a fixed seed.
inline std::vector<bsdf::Sample> draw(const View& view, int count, bsdf::Precision precision) {
  std::mt19937_64 random(2011);
  std::vector<bsdf::SampleQuery> queries(std::size_t(count), bsdf::SampleQuery{.theta_o = view.theta_o, .h = view.h});
  for (bsdf::SampleQuery& query : queries)
    for (double& u : query.u) u = double(random() >> 11) * 0x1p-53;
  std::vector<bsdf::Sample> out(queries.size());
  EXPECT_TRUE(
      bsdf::sample(view.model, *bsdf::parse_settings(view.model, "", view.settings), precision, queries, out).ok());
  return out;
}

/// Equal bins of theta_i over [-pi/2, pi/2] and of phi over [-pi, pi].
struct DirectionGrid {
  int across, around;
  int bin(double theta_i, double phi) const {
    const int row = std::min(across - 1, int((theta_i / std::numbers::pi + 0.5) * across));
    return row * around + std::min(around - 1, int((phi / (2 * std::numbers::pi) + 0.5) * around));
  }
};

/// The integral of a lobe's pdf over each bin, by products of Gauss rules.
inline std::vector<double> probabilities(const View& view, int lobe, const DirectionGrid& grid, int order) {
  const QuadratureRule rule = gauss_legendre(order);
  const double pi = std::numbers::pi, height = pi / grid.across / 2, width = pi / grid.around;
  std::vector<bsdf::Point> points;
  std::vector<double> weights;
  for (int bin = 0; bin < grid.across * grid.around; ++bin)
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        const double theta_i = (2 * (bin / grid.around) + 1 + rule.nodes[i]) * height - pi / 2;
        const double phi = (2 * (bin % grid.around) + 1 + rule.nodes[k]) * width - pi;
        points.push_back({.theta_i = theta_i, .theta_o = view.theta_o, .phi = phi, .h = view.h});
        weights.push_back(rule.weights[i] * rule.weights[k] * height * width * std::cos(theta_i));
      }
  const std::vector<double> densities = values_at(view, bsdf::Quantity::pdf, lobe, points);
  std::vector<double> result(std::size_t(grid.across * grid.around));
  const std::size_t each = rule.nodes.size() * rule.nodes.size();
  for (std::size_t i = 0; i < points.size(); ++i) result[i / each] += weights[i] * densities[i];
  return result;
}

/// Pearson's statistic in deviations from its mean; bins that expect fewer than 10 are pooled.
inline double chi_square_deviations(const std::vector<double>& counts, const std::vector<double>& expected) {
  double statistic = 0, pooled_count = 0, pooled_expected = 0;
  int used = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] < 10) {
      pooled_count += counts[i];
      pooled_expected += expected[i];
      continue;
    }
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    ++used;
  }
  if (pooled_expected > 10)
    statistic += (pooled_count - pooled_expected) * (pooled_count - pooled_expected) / pooled_expected;
  return (statistic - used) / std::sqrt(2.0 * used);
}

/// Deviations of `count` samples over the grid from the pdf of the sum.
inline double sampler_deviations(const View& view, const DirectionGrid& grid, int order, int count) {
  std::vector<double> expected = probabilities(view, -1, grid, order);
  for (double& e : expected) e *= count;
  std::vector<double> counts(expected.size());
  for (const bsdf::Sample& s : draw(view, count, bsdf::Precision::f64))
    ++counts[std::size_t(grid.bin(s.theta_i, s.phi))];
  return chi_square_deviations(counts, expected);
}

/// How far the mean weight (red) is from the albedo, in its own deviations.
inline double weight_deviations(const View& view, int count, bsdf::Precision precision) {
  double sum = 0, squares = 0;
  for (const bsdf::Sample& s : draw(view, count, precision)) {
    sum += s.weight.x;
    squares += s.weight.x * s.weight.x;
  }
  const double mean = sum / count, deviation = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
  const double albedo = values_at(view, bsdf::Quantity::albedo, -1, {{.theta_o = view.theta_o, .h = view.h}})[0];
  return std::abs(mean - albedo) / (deviation + 1e-5);
}

}  // namespace cuticle::tests
