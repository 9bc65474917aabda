#include <cuticle/shadows/light_frame.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::shadows {

Result<glm::dvec3> unit_to_light(const glm::dvec3& to_light) {
  const double length = glm::length(to_light);
  if (!std::isfinite(length) || length < 1e-12)
    return usage_error(fmt::format("light: direction ({}, {}, {}) must be finite and not zero", to_light.x, to_light.y, to_light.z),
                       "give a direction from the scene to the light, for example 1,1,0.3");
  return to_light / length;
}

// The branchless frame of Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
PlaneAxes plane_axes(const glm::dvec3& direction) {
  const double sign = std::copysign(1.0, direction.z);
  const double a = -1.0 / (sign + direction.z);
  const double b = direction.x * direction.y * a;
  return {{1 + sign * direction.x * direction.x * a, sign * b, -sign * direction.x},
          {b, sign + direction.y * direction.y * a, -direction.y}};
}

namespace {

struct Interval {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  void add(double x) { lower = std::min(lower, x), upper = std::max(upper, x); }
  double size() const { return upper - lower; }
  double center() const { return 0.5 * (lower + upper); }
};

glm::dvec3 corner(const strands::Bounds& bounds, int i) {
  return {i & 1 ? bounds.upper.x : bounds.lower.x, i & 2 ? bounds.upper.y : bounds.lower.y,
          i & 4 ? bounds.upper.z : bounds.lower.z};
}

}  // namespace

LightFrame fit_light_frame(const strands::Bounds& bounds, const glm::dvec3& to_light) {
  LightFrame frame;
  frame.forward = -to_light;
  const PlaneAxes axes = plane_axes(frame.forward);
  frame.right = axes.first;
  frame.up = axes.second;
  Interval x, y, z;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 point = corner(bounds, i);
    x.add(glm::dot(point, frame.right));
    y.add(glm::dot(point, frame.up));
    z.add(glm::dot(point, frame.forward));
  }
  frame.center_x = x.center();
  frame.center_y = y.center();
  frame.width = std::max({x.size(), y.size(), 1e-6});
  frame.near_z = z.lower;
  frame.far_z = z.lower + std::max(z.size(), 1e-4 * frame.width) * (1 + 1e-4);
  return frame;
}

}  // namespace cuticle::shadows
