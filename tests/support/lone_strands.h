#pragma once
// Grooms whose strands have nothing between them and a light from above (+y).
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "strands/groom.h"

namespace cuticle::tests {

/// A groom, and the strand of each vertex.
struct Lone {
  strands::Groom groom;
  std::vector<std::uint32_t> strands;
};

inline void add_vertex(Lone& lone, const glm::dvec3& p, float radius) {
  lone.groom.positions.emplace_back(p);
  lone.groom.radii.push_back(radius);
  lone.strands.push_back(std::uint32_t(lone.groom.strand_count()));
}
inline void end_strand(Lone& lone) { lone.groom.offsets.push_back(std::uint32_t(lone.groom.positions.size())); }

/// 36 strands of 24 vertices, 6 cm long, in a grid of 12 cm; tilted to the light from square on to along it, every
/// other one bent to an arc of half a radian. Fibre radius 0.5 mm.
inline Lone lone_strands() {
  constexpr int k_vertices = 24;
  Lone lone;
  for (int k = 0; k < 36; ++k) {
    const double tilt = 1.5707963267948966 * k / 35, turn = 2.4 * k, bend = k % 2 == 0 ? 0 : 0.5;
    glm::dvec3 p(0.12 * (k % 6), 0, 0.12 * (k / 6));
    for (int v = 0; v < k_vertices; ++v) {
      add_vertex(lone, p, 5e-4f);
      const double rise = tilt * (1 - bend * v / k_vertices);
      p += 0.06 / (k_vertices - 1) *
           glm::dvec3(std::cos(rise) * std::cos(turn), std::sin(rise), std::cos(rise) * std::sin(turn));
    }
    end_strand(lone);
  }
  return lone;
}

/// A strand that runs 6 cm along +x, turns, and comes back 2 cm above itself.
inline Lone hairpin() {
  Lone lone;
  for (int v = 0; v <= 20; ++v) add_vertex(lone, {0.003 * v, 0, 0}, 5e-4f);
  for (int v = 1; v < 10; ++v) {
    const double angle = 3.14159265358979 * v / 10;
    add_vertex(lone, {0.06 + 0.01 * std::sin(angle), 0.01 - 0.01 * std::cos(angle), 0}, 5e-4f);
  }
  for (int v = 20; v >= 0; --v) add_vertex(lone, {0.003 * v, 0.02, 0}, 5e-4f);
  end_strand(lone);
  return lone;
}

}  // namespace cuticle::tests
