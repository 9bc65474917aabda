#include "strands/spline/smooth.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/spline/bezier.glslh"
#include "strands/spline/curves.glslh"

namespace cuticle::strands {

namespace {

using Points = std::span<const glm::vec3>;

glm::vec3 tangent_at(Points hair, std::size_t i) {
  return control_tangent<float>(hair[i == 0 ? 0 : i - 1], hair[i], hair[std::min(i + 1, hair.size() - 1)]);
}

glm::vec3 before(Points hair, std::size_t i) { return i > 0 ? hair[i - 1] : mirrored<float>(hair[0], hair[1]); }
glm::vec3 after(Points hair, std::size_t i) {
  return i + 1 < hair.size() ? hair[i + 1] : mirrored<float>(hair[i], hair[i - 1]);
}

/// Where output vertex i lies among the controls: between `segment` and the next, at `place` in [0, 1].
struct CurvePlace {
  std::uint32_t segment = 0;
  float place = 0;
};
CurvePlace place_of(std::uint32_t i, std::uint32_t vertices, std::size_t controls) {
  if (controls == 1) return {};
  const auto count = std::uint32_t(controls);
  return {curve_segment(i, vertices, count), curve_place<float>(i, vertices, count)};
}

glm::vec3 point_at(Points hair, const CurvePlace& at, Curve curve) {
  if (hair.size() == 1) return hair[0];
  const std::size_t k = at.segment;
  const glm::vec3 &begin = hair[k], &end = hair[k + 1];
  switch (curve) {
    case Curve::catmull_rom:
      return catmull_rom_point<float>(before(hair, k), begin, end, after(hair, k + 1), at.place);
    case Curve::b_spline:
      return b_spline_point<float>(before(hair, k), begin, end, after(hair, k + 1), at.place);
    case Curve::bezier:
      break;
  }
  return bezier_point<float>(begin, end, tangent_at(hair, k), tangent_at(hair, k + 1), at.place);
}

/// Numbers of `components` each, linear between a hair's control vertices.
void append_linear(std::span<const float> values, std::size_t components, std::uint32_t vertices,
                   std::vector<float>& out) {
  const std::size_t controls = values.size() / components;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const CurvePlace at = place_of(i, vertices, controls);
    const float* begin = values.data() + at.segment * components;
    const float* end = controls > 1 ? begin + components : begin;
    for (std::size_t c = 0; c < components; ++c) out.push_back(begin[c] * (1 - at.place) + end[c] * at.place);
  }
}

std::vector<float> linear_per_strand(const Groom& control, std::span<const float> values, std::size_t components,
                                     std::uint32_t vertices) {
  std::vector<float> out;
  out.reserve(control.strand_count() * vertices * components);
  for (std::size_t s = 0; s < control.strand_count(); ++s)
    append_linear(values.subspan(control.offsets[s] * components, control.strand_size(s) * components), components,
                  vertices, out);
  return out;
}

void smooth_attributes(const Groom& control, std::uint32_t vertices, Groom& out) {
  for (const auto& [name, attribute] : control.attributes) {
    Attribute& result = out.attributes[name] = attribute;
    if (attribute.domain == Attribute::Domain::vertex)
      result.values = linear_per_strand(control, attribute.values, std::size_t(attribute.components), vertices);
  }
}

std::vector<std::uint32_t> even_offsets(std::size_t strands, std::uint32_t vertices) {
  std::vector<std::uint32_t> offsets(strands + 1);
  for (std::size_t s = 0; s < offsets.size(); ++s) offsets[s] = std::uint32_t(s * vertices);
  return offsets;
}

double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  const double place = squared > 0 ? glm::clamp(glm::dot(point - a, along) / squared, 0.0, 1.0) : 0;
  return glm::distance(point, a + place * along);
}

double distance_to_polyline(const glm::dvec3& point, Points line) {
  double nearest = glm::distance(point, glm::dvec3(line[0]));
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    nearest = std::min(nearest, distance_to_segment(point, glm::dvec3(line[i]), glm::dvec3(line[i + 1])));
  return nearest;
}

}  // namespace

Groom smooth(const Groom& control, int vertices, Curve curve) {
  CUTICLE_EXPECT(vertices >= 2 && vertices <= k_max_vertices, "vertices per strand outside 2 .. 256");
  const auto count = std::uint32_t(vertices);
  Groom result;
  result.offsets = even_offsets(control.strand_count(), count);
  result.root_uv = control.root_uv;
  result.root_triangle = control.root_triangle;
  result.root_barycentrics = control.root_barycentrics;
  result.positions.reserve(result.offsets.back());
  for (std::size_t s = 0; s < control.strand_count(); ++s)
    for (std::uint32_t i = 0; i < count; ++i)
      result.positions.push_back(point_at(control.strand(s), place_of(i, count, control.strand_size(s)), curve));
  result.radii = linear_per_strand(control, control.radii, 1, count);
  smooth_attributes(control, count, result);
  return result;
}

Deviation deviation_from_controls(const Groom& control, const Groom& smoothed) {
  CUTICLE_EXPECT(control.strand_count() == smoothed.strand_count(), "the same strands");
  Deviation deviation;
  for (std::size_t s = 0; s < control.strand_count(); ++s)
    for (const glm::vec3& point : smoothed.strand(s)) {
      const double distance = distance_to_polyline(glm::dvec3(point), control.strand(s));
      deviation.largest = std::max(deviation.largest, distance);
      deviation.mean += distance / double(smoothed.vertex_count());
    }
  return deviation;
}

}  // namespace cuticle::strands
