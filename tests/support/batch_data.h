#pragma once
// Arrays of directions for batches, and the angles that scalar formulas take for them.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bsdf/batch/batch.h"
#include "core/random.h"

namespace cuticle::tests {

struct Arrays {
  std::vector<float> x, y, z;
  explicit Arrays(std::size_t count) : x(count), y(count), z(count) {}
  bsdf::VectorSpans in() const { return {x, y, z}; }
  bsdf::OutputSpans out() { return {x, y, z}; }
};

/// Directions over the whole sphere, a quarter of them nearly along the fibre, offsets, random numbers.
struct Data {
  Arrays light, viewer;
  std::vector<float> h;
  std::array<std::vector<float>, 5> u;
  explicit Data(std::size_t count) : light(count), viewer(count), h(count) {
    RandomStream random(7);
    for (auto& numbers : u)
      for (std::size_t i = 0; i < count; ++i) numbers.push_back(float(random.next_word() >> 8) * 0x1p-24f);
    for (std::size_t i = 0; i < count; ++i) {
      set(light, i, random);
      set(viewer, i, random);
      h[i] = float(2 * random.next_unit() - 1);
    }
  }
  static void set(Arrays& to, std::size_t i, RandomStream& random) {
    const double s = i % 4 ? 2 * random.next_unit() - 1 : 1 - 1e-6 * random.next_unit(),
                 phi = 2 * std::numbers::pi * random.next_unit();
    to.x[i] = float(s);
    to.y[i] = float(std::sqrt(1 - s * s) * std::cos(phi));
    to.z[i] = float(std::sqrt(1 - s * s) * std::sin(phi));
  }
  bsdf::BatchPoints points() const { return {light.in(), viewer.in(), h}; }
  bsdf::BatchQueries queries() const { return {viewer.in(), h, {u[0], u[1], u[2], u[3], u[4]}}; }
  bsdf::Point point(std::size_t i) const {
    const auto theta = [&](const Arrays& v) {
      return std::atan2(double(v.x[i]), std::hypot(double(v.y[i]), double(v.z[i])));
    };
    const auto phi = [&](const Arrays& v) { return std::atan2(double(v.z[i]), double(v.y[i])); };
    return {.theta_i = theta(light), .theta_o = theta(viewer), .phi = phi(viewer) - phi(light), .h = double(h[i])};
  }
};

}  // namespace cuticle::tests
