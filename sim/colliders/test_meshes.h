#pragma once
// Closed meshes of known shape, for tests of colliders.
#include <cmath>
#include <numbers>

#include "strands/mesh.h"

namespace cuticle::sim::testing {

/// About the origin.
inline strands::Mesh box_mesh(const glm::dvec3& half) {
  strands::Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.positions.emplace_back(half * glm::dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  strands::compute_normals(mesh);
  return mesh;
}

/// About the origin: `radius` of the angle from +y and that around it; `rings` from pole to pole.
template <class Radius>
strands::Mesh shaped_mesh(int rings, const Radius& radius) {
  strands::Mesh mesh;
  const int sectors = 2 * rings;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      // All vertices of a pole are one place.
      const double polar = std::numbers::pi * r / rings,
                   around = r % rings == 0 ? 0 : 2 * std::numbers::pi * s / sectors,
                   out = r % rings == 0 ? 0 : std::sin(polar);
      mesh.positions.emplace_back(radius(polar, around) *
                                  glm::dvec3(out * std::cos(around), std::cos(polar), out * std::sin(around)));
    }
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const auto vertex = [&](int ring, int sector) { return std::uint32_t(ring * sectors + sector % sectors); };
      mesh.triangles.push_back({vertex(r, s), vertex(r, s + 1), vertex(r + 1, s)});
      mesh.triangles.push_back({vertex(r, s + 1), vertex(r + 1, s + 1), vertex(r + 1, s)});
    }
  strands::compute_normals(mesh);
  return mesh;
}

inline strands::Mesh ball_mesh(double radius, int rings) {
  return shaped_mesh(rings, [&](double, double) { return radius; });
}

/// Both in one.
inline void append(strands::Mesh& mesh, const strands::Mesh& other) {
  const auto first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace cuticle::sim::testing
