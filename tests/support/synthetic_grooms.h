#pragma once
// Small grooms with a known answer, for tests of shadow methods and studies.
#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "strands/groom.h"

namespace cuticle::tests {

inline void add_strand(strands::Groom& groom, std::initializer_list<glm::vec3> points, float radius) {
  for (const glm::vec3& point : points) groom.positions.push_back(point);
  groom.radii.resize(groom.positions.size(), radius);
  groom.offsets.push_back(std::uint32_t(groom.positions.size()));
}

inline double uniform(std::mt19937_64& random) { return double(random() >> 11) * 0x1p-53; }

/// Straight fibres of 16 vertices across a box of `width` x `depth` x `width`: random places, directions at random in
/// the plane y = constant, each running right through. Light along +y crosses them all square on.
inline strands::Groom random_slab(int count, double width, double depth, float radius, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  strands::Groom groom;
  for (int i = 0; i < count; ++i) {
    const double angle = 3.14159265358979 * uniform(random), offset = width * (uniform(random) - 0.5) * 1.41421356;
    const glm::dvec3 along(std::cos(angle), 0, std::sin(angle)), across(-along.z, 0, along.x);
    const glm::dvec3 middle = across * offset + glm::dvec3(0, depth * uniform(random), 0);
    const glm::vec3 a(middle - along * width), b(middle + along * width);
    for (int v = 0; v < 16; ++v) groom.positions.push_back(glm::mix(a, b, float(v) / 15));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), radius);
  return groom;
}

/// Length of strand above y, per area, over the square |x|, |z| <= half: what light along +y must pass.
inline double length_per_area(const strands::Groom& groom, double half, double y) {
  double length = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v) {
      const glm::dvec3 a(groom.positions[v]), b(groom.positions[v + 1]);
      int inside = 0;
      for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p = a + (b - a) * ((i + 0.5) / 100);
        inside += std::abs(p.x) <= half && std::abs(p.z) <= half && p.y > y ? 1 : 0;
      }
      length += glm::length(b - a) * inside / 100;
    }
  return length / (4 * half * half);
}

/// 40 x 40 points over the square |x|, |z| <= 0.02 at height y.
inline std::vector<glm::vec3> grid_below(double y) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 1600; ++i) points.emplace_back(0.001 * (i % 40 - 19.5), y, 0.001 * (i / 40 - 19.5));
  return points;
}

/// A coat: strands of `vertices` points on a half sphere of radius 0.1 m, `length` long, leaning a little at random.
inline strands::Groom coat(int count, int vertices, double length, float radius, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  strands::Groom groom;
  for (int i = 0; i < count; ++i) {
    const double y = uniform(random), turn = 6.28318530717959 * uniform(random), r = std::sqrt(1 - y * y);
    const glm::dvec3 normal(r * std::cos(turn), y, r * std::sin(turn));
    glm::dvec3 lean;  // number by number: the order of a call's arguments is the compiler's
    lean.z = uniform(random) - 0.5;
    lean.y = -uniform(random);
    lean.x = uniform(random) - 0.5;
    for (int v = 0; v < vertices; ++v) {
      const double t = double(v) / (vertices - 1);
      groom.positions.emplace_back(normal * (0.1 + length * t) + lean * (0.6 * length * t * t));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), radius);
  return groom;
}

/// Fifty strands along y, through any range of planes across it.
inline strands::Groom along_the_light() {
  strands::Groom groom;
  for (int i = 0; i < 50; ++i) {
    const float x = 0.001f * float(i);
    add_strand(groom, {{x, 0.1f, 0}, {x, 0.05f, 1e-6f}, {x, 0, 0}}, 0.001f);
  }
  return groom;
}

/// Four layers of fibres along x, 1 mm apart, at 45 degrees to a light from above; 0.1 m on a side. `front`: points
/// just before the first layer.
inline strands::Groom slanted_sheet(std::vector<glm::vec3>& front) {
  strands::Groom groom;
  for (int i = 0; i < 400; ++i)
    for (int layer = 0; layer < 4; ++layer) {
      const float z = 0.00025f * float(i - 200), y = z - 0.001f * float(layer);
      add_strand(groom, {{-0.05f, y, z}, {0, y, z}, {0.05f, y, z}}, 0.000125f);
      if (layer == 0) front.emplace_back(0.001f, y + 0.0001f, z);
    }
  return groom;
}

}  // namespace cuticle::tests
