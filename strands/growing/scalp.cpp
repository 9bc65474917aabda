#include "strands/growing/scalp.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

/// The scalp is a disc of rings about the crown: ring k has 6 k + 1 vertices, the first and last at the same place, so
/// that the disc is cut along the parting (the front half of the middle plane) and hair on both sides of it can be
/// combed apart.
std::uint32_t ring_start(std::uint32_t ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + (ring - 1); }

std::uint32_t ring_count_for(int vertices) {
  std::uint32_t rings = 1;
  while (std::abs(int(ring_start(rings + 2)) - vertices) < std::abs(int(ring_start(rings + 1)) - vertices)) ++rings;
  return rings;
}

/// Angle from the crown to the hairline, radians; azimuth 0 is the forehead, pi the nape.
double hairline_angle(double azimuth) {
  return (95.75 - 16.5 * std::cos(azimuth) + 2.75 * std::cos(2 * azimuth)) * std::numbers::pi / 180;
}

/// Direction of the crown's pole: 25 degrees behind the vertical.
constexpr double k_pole_tilt = 25 * std::numbers::pi / 180;

glm::dvec3 scalp_direction(double radius, double azimuth) {
  const glm::dvec3 pole(0, std::cos(k_pole_tilt), -std::sin(k_pole_tilt));
  const glm::dvec3 front(0, std::sin(k_pole_tilt), std::cos(k_pole_tilt)), side(1, 0, 0);
  const double angle = radius * hairline_angle(azimuth);
  return std::cos(angle) * pole + std::sin(angle) * (std::cos(azimuth) * front + std::sin(azimuth) * side);
}

void add_scalp_vertex(Mesh& scalp, const SkinAlong& skin, double radius, double azimuth) {
  const SkinPoint at = skin(scalp_direction(radius, azimuth));
  scalp.positions.emplace_back(at.position);
  scalp.normals.emplace_back(at.normal);
  scalp.uv.emplace_back(0.5 + 0.5 * radius * std::sin(azimuth), 0.5 + 0.5 * radius * std::cos(azimuth));
}

void add_scalp_sector(Mesh& scalp, std::uint32_t ring, std::uint32_t sector) {
  const std::uint32_t outer = ring_start(ring) + sector * ring;
  const std::uint32_t inner = ring_start(ring - 1) + sector * (ring - 1);
  for (std::uint32_t t = 0; t < ring; ++t) {
    scalp.triangles.push_back({inner + t, outer + t, outer + t + 1});
    if (t + 1 < ring) scalp.triangles.push_back({inner + t, outer + t + 1, inner + t + 1});
  }
}

}  // namespace

Mesh make_scalp(int vertices, const SkinAlong& skin) {
  const std::uint32_t rings = ring_count_for(vertices);
  Mesh scalp;
  add_scalp_vertex(scalp, skin, 0, 0);
  for (std::uint32_t ring = 1; ring <= rings; ++ring) {
    for (std::uint32_t i = 0; i <= 6 * ring; ++i)
      add_scalp_vertex(scalp, skin, double(ring) / rings, 2 * std::numbers::pi * i / (6 * ring));
    for (std::uint32_t sector = 0; sector < 6; ++sector) add_scalp_sector(scalp, ring, sector);
  }
  return scalp;
}

}  // namespace cuticle::strands
