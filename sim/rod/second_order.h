#pragma once
// Numbers that carry their first and second derivatives by three variables.
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace cuticle::sim::rod {

struct SecondOrder {
  double value = 0;
  glm::dvec3 first{0};
  glm::dmat3 second{0};
};

inline double value_of(double number) { return number; }
inline double value_of(const SecondOrder& number) { return number.value; }

inline SecondOrder operator+(const SecondOrder& a, const SecondOrder& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}
inline SecondOrder operator-(const SecondOrder& a, double b) { return {a.value - b, a.first, a.second}; }
inline SecondOrder operator*(const SecondOrder& a, double b) { return {a.value * b, a.first * b, a.second * b}; }
inline SecondOrder operator*(const SecondOrder& a, const SecondOrder& b) {
  return {a.value * b.value, a.first * b.value + b.first * a.value,
          a.second * b.value + b.second * a.value + glm::outerProduct(a.first, b.first) +
              glm::outerProduct(b.first, a.first)};
}

/// f(x), from f and its first two derivatives at x.
inline SecondOrder composed(const SecondOrder& x, double f, double first, double second) {
  return {f, x.first * first, x.second * first + glm::outerProduct(x.first, x.first) * second};
}
inline double composed(double, double f, double, double) { return f; }

/// The angle of (x, y), of which both are linear in the variables.
inline SecondOrder angle_of(const SecondOrder& y, const SecondOrder& x) {
  const double squared = x.value * x.value + y.value * y.value, fourth = squared * squared;
  const double yy = -2 * x.value * y.value / fourth, xy = (y.value * y.value - x.value * x.value) / fourth;
  return {std::atan2(y.value, x.value), (y.first * x.value - x.first * y.value) / squared,
          glm::outerProduct(y.first, y.first) * yy - glm::outerProduct(x.first, x.first) * yy +
              (glm::outerProduct(x.first, y.first) + glm::outerProduct(y.first, x.first)) * xy};
}
inline double angle_of(double y, double x) { return std::atan2(y, x); }

}  // namespace cuticle::sim::rod
