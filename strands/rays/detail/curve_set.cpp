#include "strands/rays/detail/curve_set.h"

#include <algorithm>

#include <glm/common.hpp>

namespace cuticle::strands {

CurveSet::CurveSet(const Groom& groom, std::span<const glm::vec3> positions_at_end, CurveKind kind)
    : kind_(kind), offsets_(groom.offsets), controls_(controls_of(groom, groom.positions)) {
  if (!positions_at_end.empty()) controls_at_end_ = controls_of(groom, positions_at_end);
  const auto step = std::uint32_t(vertices_of_span());
  const std::uint32_t points = kind.basis == SplineBasis::linear ? 2 : 4;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = offsets_[s]; v + step < offsets_[s + 1]; v += step) {
      const std::uint32_t first = first_control({s, v});
      const auto is_there = [&](std::uint32_t k) {
        return glm::vec3(controls_[first + k]) == glm::vec3(controls_[first]);
      };
      bool has_length = false;
      for (std::uint32_t k = 1; k < points; ++k) has_length = has_length || !is_there(k);
      if (!has_length) continue;
      first_.push_back(first);
      places_.push_back({s, v});
    }
}

std::vector<glm::vec4> CurveSet::controls_of(const Groom& groom, std::span<const glm::vec3> positions) const {
  const bool beyond_ends = kind_.basis == SplineBasis::b_spline || kind_.basis == SplineBasis::catmull_rom;
  std::vector<glm::vec4> controls;
  controls.reserve(positions.size() + (beyond_ends ? 2 * groom.strand_count() : 0));
  const auto beyond = [&](std::uint32_t end, std::uint32_t next) {
    const glm::vec4 here(positions[end], groom.radii[end]), there(positions[next], groom.radii[next]);
    const glm::vec4 point = 2.0f * here - there;
    return glm::vec4(glm::vec3(point), std::max(0.0f, point.w));
  };
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s) {
    const std::uint32_t begin = groom.offsets[s], end = groom.offsets[s + 1];
    const bool alone = end - begin < 2;
    if (beyond_ends && begin < end) controls.push_back(beyond(begin, alone ? begin : begin + 1));
    for (std::uint32_t v = begin; v < end; ++v) controls.emplace_back(positions[v], groom.radii[v]);
    if (beyond_ends && begin < end) controls.push_back(beyond(end - 1, alone ? begin : end - 2));
  }
  return controls;
}

CurveSpan CurveSet::span_from(std::uint32_t first, double time) const {
  std::array<glm::dvec4, 4> points{};
  const std::size_t count = kind_.basis == SplineBasis::linear ? 2 : 4;
  for (std::size_t k = 0; k < count; ++k) {
    points[k] = controls_[first + k];
    if (!controls_at_end_.empty()) points[k] = glm::mix(points[k], glm::dvec4(controls_at_end_[first + k]), time);
  }
  return curve_span(kind_.basis, points);
}

std::uint32_t CurveSet::first_control(const CurvePlace& place) const {
  const std::uint32_t begin = offsets_[place.strand];
  switch (kind_.basis) {
    case SplineBasis::linear:
      return place.vertex;
    case SplineBasis::bezier:
      return begin + (place.vertex - begin) / 3 * 3;
    case SplineBasis::b_spline:
    case SplineBasis::catmull_rom:
      break;
  }
  return place.vertex + 2 * place.strand;
}

CurvePlace CurveSet::place(std::uint32_t primitive, double u) const {
  CurvePlace place = places_[primitive];
  const int pieces = vertices_of_span(), piece = std::min(int(u * pieces), pieces - 1);
  place.vertex += std::uint32_t(piece);
  place.share = u * pieces - piece;
  return place;
}

double CurveSet::parameter(const CurvePlace& place) const {
  const auto pieces = std::uint32_t(vertices_of_span());
  return ((place.vertex - offsets_[place.strand]) % pieces + place.share) / pieces;
}

}  // namespace cuticle::strands
