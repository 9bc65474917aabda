#pragma once
// Places where formulas of fibres break first, by the numbers of a seeded generator.
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/model_values.h"

namespace cuticle::tests {

/// One of four.
inline double pick(std::mt19937& random, const std::array<double, 4>& choices) { return choices[random() % 4]; }

/// A point drawn over the whole domain, or one whose angles are poles, mirror directions, the caustic of an index of
/// 1.55, or next to them, and whose offset is an edge.
inline bsdf::Point hard_point(std::mt19937& random) {
  constexpr std::array<double, 8> angles = {0, 1e-9, 0.3, 30, 60, 89, 89.999, 90},
                                  phis = {0, 1e-9, 18.62, 90, 120, 179.999, 180, 360};
  const double degree = std::numbers::pi / 180;
  const auto uniform = [&] { return double(random()) / 4294967296.0 * 2 - 1; };
  const auto angle = [&] {
    return (random() % 2 ? 90 * uniform() : (random() % 2 ? -1 : 1) * angles[random() % 8]) * degree;
  };
  const double offset = random() % 4 ? uniform() : (random() % 2 ? -1 : 1);
  return {angle(), angle(), angle(), (random() % 2 ? 180 * uniform() : phis[random() % 8]) * degree, offset};
}
inline std::vector<bsdf::Point> hard_points(std::mt19937& random, int count) {
  std::vector<bsdf::Point> points;
  for (int i = 0; i < count; ++i) points.push_back(hard_point(random));
  return points;
}

inline void expect_finite_and_not_negative(const ValuesOf& model, const std::string& settings, bsdf::Quantity quantity,
                                           int lobe, const std::vector<bsdf::Point>& points,
                                           bsdf::Precision precision) {
  const std::vector<glm::dvec3> values = model(settings, quantity, lobe, points, precision);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_TRUE(std::isfinite(values[i][c]) && values[i][c] >= 0)
          << settings << " quantity " << int(quantity) << " lobe " << lobe << " at " << points[i].theta_i << " "
          << points[i].theta_o << " " << points[i].theta_d << " " << points[i].phi << " " << points[i].h;
}

}  // namespace cuticle::tests
