#include "strands/growing/face_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

/// A bump of height 1 about `middle` that falls to 1 / e at `width` from it.
double bump(double x, double middle, double width) {
  const double off = (x - middle) / width;
  return std::exp(-off * off);
}

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Triangles between the rows of a grid whose columns close to a ring where `closed`.
void add_grid(int rows, int columns, bool closed, Mesh& mesh) {
  for (int row = 0; row + 1 < rows; ++row)
    for (int k = 0; k + (closed ? 0 : 1) < columns; ++k) {
      const auto at = [&](int r, int c) { return std::uint32_t(r * columns + c % columns); };
      const std::uint32_t a = at(row, k), b = at(row, k + 1), c = at(row + 1, k), d = at(row + 1, k + 1);
      mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
    }
}

/// Height of an ear's front over its base, metres. `radius` 0 .. 1 from the middle; `turn` from the front, upwards.
double ear_height(double radius, double turn) {
  const double up = std::sin(turn), rim = smooth_step(-0.85, -0.35, up);
  const double behind = smooth_step(0.9, -0.2, std::cos(turn) + 0.4 * (up < 0 ? up : 0));
  const double hollow = -0.007 * bump(radius, 0.1, 0.33);
  const double fold = 0.0028 * behind * bump(radius, 0.56, 0.12), helix = 0.0042 * rim * bump(radius, 0.9, 0.11);
  const double lobe = 0.003 * (1 - rim) * bump(radius, 0.6, 0.35);
  return hollow + fold + helix + lobe - 0.012 * smooth_step(0.93, 1.0, radius);
}

}  // namespace

Mesh make_ear() {
  constexpr int k_rings = 40, k_around = 72;
  // Leaning back by 12 degrees, its hind edge 25 degrees off the head.
  const glm::dvec3 middle(0.0795, 0.101, -0.017), up(0.06, 0.975, -0.21), out(0.90, -0.05, 0.42);
  const glm::dvec3 front = glm::normalize(glm::cross(up, out));
  Mesh ear;
  for (int ring = 0; ring < k_rings; ++ring)
    for (int k = 0; k < k_around; ++k) {
      const double radius = double(ring) / (k_rings - 1), turn = 2 * std::numbers::pi * k / k_around;
      const double high = std::sin(turn), wide = 0.0175 + 0.004 * high - 0.003 * (high < 0 ? high * high : 0);
      const double backward = high < 0 ? 0.004 * high * high : 0;
      ear.positions.emplace_back(middle + front * (radius * (wide * std::cos(turn) + backward)) +
                                 up * (radius * 0.0325 * high) + glm::normalize(out) * ear_height(radius, turn));
    }
  add_grid(k_rings, k_around, true, ear);
  return ear;
}

Mesh make_eyelids() {
  constexpr int k_rows = 40, k_columns = 40;
  constexpr double k_reach = 1.15, k_seam = -0.22;  // radians about the eyeball's middle
  const glm::dvec3 middle(0.031, 0.107, 0.0715);
  Mesh lids;
  for (int row = 0; row < k_rows; ++row)
    for (int k = 0; k < k_columns; ++k) {
      const double height = k_reach * (1 - 2.0 * row / (k_rows - 1)), side = k_reach * (2.0 * k / (k_columns - 1) - 1);
      // The seam sinks to the outer corner, the crease runs above it.
      const double above = height - (k_seam + 0.10 * side * side - 0.05 * side),
                   edge = std::max(std::abs(height), std::abs(side));
      const double inside = 1 - smooth_step(0.75, k_reach, edge);
      const double radius = 0.0138 - 0.0007 * bump(above, -0.02, 0.045) + 0.0007 * bump(above, 0.06, 0.05) -
                            0.0006 * bump(above, 0.62, 0.09) - 0.004 * (1 - inside);
      lids.positions.emplace_back(middle + radius * glm::dvec3(std::sin(side) * std::cos(height),
                                                               0.9 * std::sin(height),
                                                               std::cos(side) * std::cos(height)));
    }
  add_grid(k_rows, k_columns, false, lids);
  return lids;
}

Mesh make_lips() {
  constexpr int k_rows = 40, k_columns = 48;
  constexpr double k_half = 0.0225, k_beyond = 1.3;
  Mesh lips;
  for (int row = 0; row < k_rows; ++row)
    for (int k = 0; k < k_columns; ++k) {
      const double u = 2.0 * k / (k_columns - 1) - 1, s = k_beyond * (1 - 2.0 * row / (k_rows - 1)), at = std::abs(s);
      const double narrow = std::max(1 - u * u, 0.0), seam = 0.0492 + 0.0009 * std::cos(7 * u) * narrow;
      const double upper = 0.0062 * std::pow(narrow, 0.8) * (1 - 0.18 * bump(u, 0, 0.13));
      const double lower = 0.0074 * std::pow(narrow, 0.6);
      const double bulge = at < 1 ? 0.0034 * std::sin(std::numbers::pi * std::pow(at, 0.7)) : -0.02 * (at - 1);
      lips.positions.emplace_back(k_half * u, seam + s * (s > 0 ? upper : lower),
                                  0.0912 - 0.0105 * u * u + bulge * std::sqrt(narrow) - 0.0022 * bump(s, 0, 0.09));
    }
  add_grid(k_rows, k_columns, false, lips);
  return lips;
}

}  // namespace cuticle::strands
