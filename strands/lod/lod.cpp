#include "strands/lod/lod.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "strands/lod/lod.glslh"
#include "strands/spline/smooth.h"

namespace cuticle::strands {

namespace {

template <class T>
void append_range(const std::vector<T>& from, std::size_t first, std::size_t size, std::vector<T>& out) {
  if (!from.empty())
    out.insert(out.end(), from.begin() + std::ptrdiff_t(first), from.begin() + std::ptrdiff_t(first + size));
}

void append_strand(const Groom& groom, std::uint32_t strand, Groom& out) {
  const std::size_t first = groom.offsets[strand], size = groom.strand_size(strand);
  append_range(groom.positions, first, size, out.positions);
  append_range(groom.radii, first, size, out.radii);
  append_range(groom.root_uv, strand, 1, out.root_uv);
  append_range(groom.root_triangle, strand, 1, out.root_triangle);
  append_range(groom.root_barycentrics, strand, 1, out.root_barycentrics);
  for (const auto& [name, attribute] : groom.attributes) {
    const auto components = std::size_t(attribute.components);
    const bool per_strand = attribute.domain == Attribute::Domain::strand;
    append_range(attribute.values, components * (per_strand ? strand : first), components * (per_strand ? 1 : size),
                 out.attributes[name].values);
  }
  out.offsets.push_back(std::uint32_t(out.positions.size()));
}

/// Visits segments with their area: ends, length x width.
template <class Visit>
void for_each_segment(const Groom& groom, std::size_t strands, const Visit& visit) {
  for (std::size_t s = 0; s < strands; ++s)
    for (std::size_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v) {
      const glm::dvec3 a(groom.positions[v]), b(groom.positions[v + 1]);
      visit(a, b, glm::distance(a, b) * (double(groom.radii[v]) + double(groom.radii[v + 1])));
    }
}

double area_of(const Groom& groom, std::size_t strands) {
  double area = 0;
  for_each_segment(groom, strands, [&](const glm::dvec3&, const glm::dvec3&, double part) { area += part; });
  return area;
}

/// Area per cell, seen along each axis.
class CoverageGrid {
 public:
  CoverageGrid(const Bounds& bounds, int cells)
      : lower_(bounds.lower), cells_(cells), sums_(std::size_t(3 * cells * cells), 0) {
    const glm::dvec3 side = glm::dvec3(bounds.upper) - lower_;
    scale_ = cells / std::max({side.x, side.y, side.z, 1e-12});
  }
  void add(const Groom& groom, double sign) {
    for_each_segment(groom, groom.strand_count(), [&](const glm::dvec3& a, const glm::dvec3& b, double area) {
      constexpr int samples = 8;
      for (int k = 0; k < samples; ++k) add_point(a + (b - a) * ((k + 0.5) / samples), sign * area / samples);
    });
  }
  double root_sum_of_squares() const {
    return std::sqrt(std::inner_product(sums_.begin(), sums_.end(), sums_.begin(), 0.0));
  }

 private:
  void add_point(const glm::dvec3& point, double area) {
    const glm::ivec3 cell = glm::clamp(glm::ivec3((point - lower_) * scale_), 0, cells_ - 1);
    for (int axis = 0; axis < 3; ++axis)
      sums_[std::size_t((axis * cells_ + cell[(axis + 1) % 3]) * cells_ + cell[(axis + 2) % 3])] += area;
  }

  glm::dvec3 lower_;
  int cells_;
  double scale_ = 1;
  std::vector<double> sums_;
};

}  // namespace

Groom selected(const Groom& groom, const std::vector<std::uint32_t>& strands) {
  Groom result;
  for (const auto& [name, attribute] : groom.attributes)
    result.attributes[name] = {attribute.domain, attribute.components, {}};
  for (std::uint32_t strand : strands) append_strand(groom, strand, result);
  return result;
}

double covered_pixels(const Bounds& bounds, const Camera& camera) {
  const glm::dmat4 to_clip = projection_matrix(camera) * view_matrix(camera);
  const double picture = double(camera.resolution.x) * camera.resolution.y;
  glm::dvec2 lower(1), upper(-1);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point(corner & 1 ? bounds.upper.x : bounds.lower.x, corner & 2 ? bounds.upper.y : bounds.lower.y,
                           corner & 4 ? bounds.upper.z : bounds.lower.z);
    const glm::dvec4 clip = to_clip * glm::dvec4(point, 1);
    if (!(clip.w > camera.near_plane)) return picture;
    lower = glm::min(lower, glm::dvec2(clip) / clip.w);
    upper = glm::max(upper, glm::dvec2(clip) / clip.w);
  }
  const glm::dvec2 side = glm::max(glm::min(upper, 1.0) - glm::max(lower, -1.0), 0.0);
  return side.x * side.y / 4 * picture * std::numbers::pi / 4;
}

LevelOfDetail level_of_detail(const Groom& groom, double covered_px, double full_px, double least) {
  CUTICLE_EXPECT(full_px > 0 && least > 0 && least <= 1, "a level of detail has positive limits");
  if (groom.strand_count() == 0) return {};
  const double share = drawn_share<double>(covered_px, full_px, least);
  LevelOfDetail level;
  level.strands = drawn_strands(std::uint32_t(groom.strand_count()), float(share));
  level.vertices = std::uint32_t(drawn_vertices<double>(double(groom.strand_size(0)), share));
  if (level.strands == groom.strand_count()) return level;
  const double kept = area_of(groom, level.strands);
  level.width = kept > 0 ? area_of(groom, groom.strand_count()) / kept : 1;
  return level;
}

Groom at_level(const Groom& groom, const LevelOfDetail& level) {
  std::vector<std::uint32_t> prefix(level.strands);
  std::iota(prefix.begin(), prefix.end(), 0u);
  Groom result = selected(groom, prefix);
  if (!prefix.empty() && level.vertices >= 2 && level.vertices < result.strand_size(0))
    result = smooth(result, int(level.vertices));
  for (float& radius : result.radii) radius = float(double(radius) * level.width);
  return result;
}

LevelError level_error(const Groom& full, const Groom& reduced, int cells) {
  CoverageGrid grid(bounds(full), cells);
  grid.add(full, 1);
  const double whole = grid.root_sum_of_squares(), area = area_of(full, full.strand_count());
  grid.add(reduced, -1);
  LevelError error;
  error.area = area > 0 ? std::abs(area_of(reduced, reduced.strand_count()) / area - 1) : 0;
  error.cells = whole > 0 ? grid.root_sum_of_squares() / whole : 0;
  return error;
}

}  // namespace cuticle::strands
