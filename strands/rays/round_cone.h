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

/// The line origin + t direction (unit) in a sphere: position, radius.
inline void add_sphere(LineInterval& interval, const glm::dvec3& origin, const glm::dvec3& direction,
                       const glm::vec4& sphere) {
  const glm::dvec3 away = origin - glm::dvec3(sphere);
  const double middle = glm::dot(away, direction);
  const double square = middle * middle - glm::dot(away, away) + double(sphere.w) * double(sphere.w);
  if (!(square > 0)) return;
  const double half = std::sqrt(square);
  interval.add(-middle - half);
  interval.add(-middle + half);
}

/// The line origin + t direction (unit) in the hull of the spheres around `a` and `b` of the radii in their w. The cone
/// touches both spheres; in units of |b - a|^2, heights along it run from 0 at the circle on one to `body` on the
/// other. Most lines that meet it pass through the cone's side alone, or beside it: then the spheres are not asked.
inline LineInterval round_cone_interval(const glm::dvec3& origin, const glm::dvec3& direction, const glm::vec4& a,
                                        const glm::vec4& b) {
  LineInterval interval;
  const glm::dvec3 axis = glm::dvec3(b) - glm::dvec3(a), away = origin - glm::dvec3(a);
  const double radius = double(a.w), taper = radius - double(b.w), square = glm::dot(axis, axis);
  const double body = square - taper * taper;
  if (body > 0) {  // else one sphere holds the other
    const double along = glm::dot(axis, direction), begin = glm::dot(axis, away);
    const double slope = body - along * along;
    const double middle = body * glm::dot(direction, away) - begin * along + along * taper * radius;
    const double rest =
        body * glm::dot(away, away) - begin * begin + 2 * begin * taper * radius - square * radius * radius;
    const double roots = middle * middle - slope * rest;
    if (slope > 0 && !(roots > 0)) return interval;  // beside the whole cone, which holds both spheres
    const auto passes_side = [&](double t) {
      const double height = begin - taper * radius + t * along;
      if (!(height > 0 && height < body)) return false;
      interval.add(t);
      return true;
    };
    if (slope != 0 && roots > 0) {
      const double half = std::sqrt(roots);
      const bool first = passes_side((-half - middle) / slope), second = passes_side((half - middle) / slope);
      if (first && second) return interval;
    }
  }
  add_sphere(interval, origin, direction, a);
  add_sphere(interval, origin, direction, b);
  return interval;
}

}  // namespace cuticle::strands
