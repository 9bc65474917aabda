#include "strands/growing/head_shape.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

struct Ellipsoid {
  glm::dvec3 center, radii;
  double blend;  ///< width of the smooth seam to what stands before it, metres
};

// Mirrored in x: the point's |x| is used. Measures follow an adult head: 0.15 m wide, 0.19 m deep, 0.23 m tall.
constexpr Ellipsoid k_parts[] = {
    {{0, 0.145, -0.012}, {0.075, 0.085, 0.095}, 0},          // skull
    {{0, 0.092, 0.024}, {0.061, 0.080, 0.060}, 0.025},       // face
    {{0, 0.030, 0.052}, {0.030, 0.023, 0.033}, 0.030},       // chin
    {{0.036, 0.052, 0.014}, {0.026, 0.036, 0.046}, 0.025},   // jaw
    {{0.042, 0.087, 0.054}, {0.018, 0.016, 0.016}, 0.022},   // cheek
    {{0.022, 0.124, 0.074}, {0.030, 0.009, 0.013}, 0.016},   // brow
    {{0, 0.097, 0.088}, {0.0085, 0.026, 0.014}, 0.014},      // bridge of the nose
    {{0, 0.080, 0.101}, {0.0115, 0.010, 0.012}, 0.012},      // tip of the nose
    {{0.010, 0.078, 0.093}, {0.0075, 0.007, 0.008}, 0.007},  // nostril
    {{0, 0.0555, 0.0800}, {0.021, 0.0085, 0.0110}, 0.012},   // upper lip
    {{0, 0.0440, 0.0785}, {0.018, 0.0080, 0.0110}, 0.012},   // lower lip
    {{0, -0.005, -0.028}, {0.049, 0.120, 0.053}, 0.030},     // neck
};
constexpr Ellipsoid k_ear = {{0.077, 0.104, -0.012}, {0.010, 0.030, 0.017}, 0.006};
constexpr Ellipsoid k_eye_socket = {{0.031, 0.1075, 0.098}, {0.0190, 0.0120, 0.0170}, 0.012};
constexpr Ellipsoid k_eye_ball = {{0.031, 0.1070, 0.0715}, {0.0135, 0.0115, 0.0130}, 0.004};
constexpr double k_neck_end = -0.06, k_neck_rim = 0.03;

double ellipsoid_distance(const glm::dvec3& point, const Ellipsoid& part) {
  const glm::dvec3 q = point - part.center;
  const double scaled = glm::length(q / part.radii);
  const double slope = glm::length(q / (part.radii * part.radii));
  if (slope == 0) return -std::min({part.radii.x, part.radii.y, part.radii.z});
  return scaled * (scaled - 1) / slope;
}

/// Smaller of two distances with a rounded seam of the given width.
double smooth_union(double a, double b, double width) {
  if (width == 0) return std::min(a, b);
  const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * overlap * overlap;
}

}  // namespace

double head_distance(const glm::dvec3& point) {
  const glm::dvec3 half(std::abs(point.x), point.y, point.z);
  double distance = 1;
  for (const Ellipsoid& part : k_parts) distance = smooth_union(distance, ellipsoid_distance(half, part), part.blend);
  distance = -smooth_union(-distance, ellipsoid_distance(half, k_eye_socket), k_eye_socket.blend);
  distance = smooth_union(distance, ellipsoid_distance(half, k_eye_ball), k_eye_ball.blend);
  distance = smooth_union(distance, ellipsoid_distance(half, k_ear), k_ear.blend);
  return -smooth_union(-distance, point.y - k_neck_end, k_neck_rim);
}

glm::dvec3 head_normal(const glm::dvec3& point) {
  constexpr double step = 5e-4;
  glm::dvec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 offset(0);
    offset[axis] = step;
    gradient[axis] = head_distance(point + offset) - head_distance(point - offset);
  }
  return glm::normalize(gradient);
}

glm::dvec3 head_surface_point(const glm::dvec3& origin, const glm::dvec3& direction) {
  constexpr double step = 4e-3;  // thinner than every part
  double inside = 0, outside = 0;
  while (head_distance(origin + direction * outside) < 0) {
    inside = outside;
    outside += step;
  }
  for (int i = 0; i < 22; ++i) {
    const double middle = 0.5 * (inside + outside);
    (head_distance(origin + direction * middle) < 0 ? inside : outside) = middle;
  }
  return origin + direction * outside;
}

}  // namespace cuticle::strands
