#include "strands/growing/growing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>

#include "strands/growing/head_shape.h"

namespace cuticle::strands {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A sphere of triangles: an icosahedron whose edges are halved `levels` times; unit directions.
struct DirectionMesh {
  std::vector<glm::dvec3> directions;
  Triangles triangles;
};

DirectionMesh icosahedron() {
  const double g = std::numbers::phi;
  DirectionMesh mesh;
  mesh.directions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::dvec3& direction : mesh.directions) direction = glm::normalize(direction);
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

DirectionMesh halved(const DirectionMesh& coarse) {
  DirectionMesh fine{coarse.directions, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), std::uint32_t(fine.directions.size()));
    if (is_new) fine.directions.push_back(glm::normalize(fine.directions[a] + fine.directions[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

Mesh make_head_mesh() {
  constexpr int levels = 5;
  DirectionMesh sphere = icosahedron();
  for (int level = 0; level < levels; ++level) sphere = halved(sphere);
  const glm::dvec3 center(k_head_center[0], k_head_center[1], k_head_center[2]);
  Mesh mesh;
  mesh.triangles = std::move(sphere.triangles);
  for (const glm::dvec3& direction : sphere.directions)
    mesh.positions.emplace_back(head_surface_point(center, direction));
  compute_normals(mesh);
  return mesh;
}

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
const glm::dvec3 k_skull_center(0, 0.14, -0.01);

glm::dvec3 scalp_direction(double radius, double azimuth) {
  const glm::dvec3 pole(0, std::cos(k_pole_tilt), -std::sin(k_pole_tilt));
  const glm::dvec3 front(0, std::sin(k_pole_tilt), std::cos(k_pole_tilt)), side(1, 0, 0);
  const double angle = radius * hairline_angle(azimuth);
  return std::cos(angle) * pole + std::sin(angle) * (std::cos(azimuth) * front + std::sin(azimuth) * side);
}

void add_scalp_vertex(Mesh& scalp, double radius, double azimuth) {
  const glm::dvec3 point = head_surface_point(k_skull_center, scalp_direction(radius, azimuth));
  scalp.positions.emplace_back(point);
  scalp.normals.emplace_back(head_normal(point));
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

Mesh make_scalp(std::uint32_t rings) {
  Mesh scalp;
  add_scalp_vertex(scalp, 0, 0);
  for (std::uint32_t ring = 1; ring <= rings; ++ring) {
    for (std::uint32_t i = 0; i <= 6 * ring; ++i)
      add_scalp_vertex(scalp, double(ring) / rings, 2 * std::numbers::pi * i / (6 * ring));
    for (std::uint32_t sector = 0; sector < 6; ++sector) add_scalp_sector(scalp, ring, sector);
  }
  return scalp;
}

}  // namespace

Head make_head(int scalp_vertices) {
  CUTICLE_EXPECT(scalp_vertices >= 8 && scalp_vertices <= 100000, "scalp vertices outside 8 .. 100000");
  Head head;
  static const Mesh mesh = make_head_mesh();  // always the same, and not cheap
  head.mesh = mesh;
  head.scalp = make_scalp(ring_count_for(scalp_vertices));
  head.colliders = {{{0, 0.150, 0.008}, 0.069},    // front of the skull
                    {{0, 0.148, -0.032}, 0.070},   // back of the skull
                    {{0, 0.092, 0.030}, 0.050},    // face
                    {{0, 0.045, 0.030}, 0.040},    // jaw
                    {{0, 0.000, -0.028}, 0.046}};  // neck
  return head;
}

}  // namespace cuticle::strands
