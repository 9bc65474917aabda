#pragma once
// Where a line passes through a round cone: the hull of two spheres.
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cuticle::strands {

/// Distances along a line, from the first to the last point of a convex body; first > last: it is not met.
struct LineInterval {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  void add(double distance) {
    first = std::min(first, distance);
    last = std::max(last, distance);
  }
};

/// Adds the real roots of a t^2 + 2 b t + c that `counts` accepts.
void add_roots(LineInterval& interval, double a, double b, double c, const auto& counts) {
  const double square = b * b - a * c;
  if (!(square > 0) || a == 0) return;
  for (const double root : {-std::sqrt(square), std::sqrt(square)})
    if (const double t = (root - b) / a; counts(t)) interval.add(t);
}

/// The line origin + t direction (unit) in the hull of the spheres around `a` and `b` of the radii in their w. The cone
/// touches both spheres; in units of |b - a|^2, heights along it run from 0 at the circle on one to `body` on the
/// other.
inline LineInterval round_cone_interval(const glm::dvec3& origin, const glm::dvec3& direction, const glm::vec4& a,
                                        const glm::vec4& b) {
  LineInterval interval;
  for (const glm::vec4& sphere : {a, b}) {
    const glm::dvec3 away = origin - glm::dvec3(sphere);
    const double radius = double(sphere.w);
    add_roots(interval, 1, glm::dot(away, direction), glm::dot(away, away) - radius * radius,
              [](double) { return true; });
  }
  const glm::dvec3 axis = glm::dvec3(b) - glm::dvec3(a), away = origin - glm::dvec3(a);
  const double radius = double(a.w), taper = radius - double(b.w), square = glm::dot(axis, axis);
  const double body = square - taper * taper;
  if (!(body > 0)) return interval;  // one sphere holds the other
  const double along = glm::dot(axis, direction), begin = glm::dot(axis, away);
  const double slope = body - along * along;
  const double middle = body * glm::dot(direction, away) - begin * along + along * taper * radius;
  const double rest =
      body * glm::dot(away, away) - begin * begin + 2 * begin * taper * radius - square * radius * radius;
  add_roots(interval, slope, middle, rest, [&](double t) {
    const double height = begin - taper * radius + t * along;
    return height > 0 && height < body;
  });
  return interval;
}

}  // namespace cuticle::strands
