// Neck and shoulders as rings of superellipses, blended by Catmull-Rom curves through a few sections.
#include "strands/growing/bust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/growing/face_parts.h"
#include "strands/spline/curves.glslh"

namespace cuticle::strands {

namespace {

/// Half widths to the side and to the front, the middle's place, metres; the exponent of the superellipse.
struct Section {
  double height, side, front, middle, exponent;
};
// An adult's: the neck 0.11 m wide, shoulders 0.40 m across, 0.15 m below the chin.
constexpr Section k_sections[] = {{0.020, 0.036, 0.038, -0.028, 2},    {-0.020, 0.043, 0.046, -0.028, 2},
                                  {-0.045, 0.0472, 0.0505, -0.028, 2}, {-0.070, 0.054, 0.055, -0.030, 2},
                                  {-0.092, 0.070, 0.060, -0.032, 2},   {-0.108, 0.112, 0.070, -0.033, 2},
                                  {-0.126, 0.160, 0.082, -0.033, 2.2}, {-0.155, 0.196, 0.094, -0.030, 2.4},
                                  {-0.210, 0.212, 0.105, -0.026, 2.5}, {-0.300, 0.205, 0.112, -0.022, 2.5}};
constexpr int k_between = 6, k_around = 96;

double signed_power(double value, double power) { return std::copysign(std::pow(std::abs(value), power), value); }

Section section_at(int ring) {
  const int last = int(std::size(k_sections)) - 1, begin = std::min(ring / k_between, last - 1);
  const double place = double(ring - begin * k_between) / k_between;
  const auto blend = [&](double Section::*member) {
    const auto at = [&](int k) { return k_sections[std::clamp(k, 0, last)].*member; };
    const glm::dvec3 point = catmull_rom_point<double>(glm::dvec3(at(begin - 1)), glm::dvec3(at(begin)),
                                                       glm::dvec3(at(begin + 1)), glm::dvec3(at(begin + 2)), place);
    return point.x;
  };
  return {blend(&Section::height), blend(&Section::side), blend(&Section::front), blend(&Section::middle),
          blend(&Section::exponent)};
}

Mesh make_shoulders() {
  constexpr int k_rings = (int(std::size(k_sections)) - 1) * k_between + 1;
  Mesh mesh;
  for (int ring = 0; ring < k_rings; ++ring) {
    const Section section = section_at(ring);
    for (int k = 0; k < k_around; ++k) {
      const double angle = 2 * std::numbers::pi * k / k_around, power = 2 / section.exponent;
      mesh.positions.emplace_back(section.side * signed_power(std::sin(angle), power), section.height,
                                  section.middle + section.front * signed_power(std::cos(angle), power));
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < k_rings; ++ring)
    for (std::uint32_t k = 0; k < k_around; ++k) {
      const std::uint32_t a = ring * k_around + k, b = ring * k_around + (k + 1) % k_around, c = a + k_around,
                          d = b + k_around;
      mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
    }
  return mesh;
}

/// A part, on the side of `side` times its own.
void append(const Mesh& part, float side, Mesh& head) {
  const auto first = std::uint32_t(head.positions.size());
  for (const glm::vec3& point : part.positions) head.positions.emplace_back(side * point.x, point.y, point.z);
  for (auto [a, b, c] : part.triangles) {
    if (side < 0) std::swap(b, c);
    head.triangles.push_back({first + a, first + b, first + c});
  }
}

/// The head's neck narrows downward where the shoulders' widens: about where they cross, both take the normal of one
/// upright ellipse, and light shows no edge.
void join_normals_of_necks(Mesh& head) {
  constexpr float k_crossing = -0.042f, k_reach = 0.032f, k_side = 0.047f, k_front = 0.050f, k_middle = -0.028f;
  for (std::size_t i = 0; i < head.positions.size(); ++i) {
    const glm::vec3& point = head.positions[i];
    const float away = glm::smoothstep(0.3f, 1.0f, std::abs(point.y - k_crossing) / k_reach);
    if (away == 1) continue;
    const glm::vec3 upright(point.x / (k_side * k_side), 0, (point.z - k_middle) / (k_front * k_front));
    head.normals[i] = glm::normalize(glm::mix(glm::normalize(upright), head.normals[i], away));
  }
}

}  // namespace

void add_bust(Mesh& head) {
  append(make_shoulders(), 1, head);
  append(make_lips(), 1, head);
  for (const Mesh& part : {make_ear(), make_eyelids()})
    for (const float side : {1.0f, -1.0f}) append(part, side, head);
  head.uv.clear();
  compute_normals(head);
  join_normals_of_necks(head);
}

}  // namespace cuticle::strands
