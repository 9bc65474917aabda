#include <cuticle/strands/groom.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <cuticle/strands/tangent.glslh>

namespace cuticle::strands {

namespace {

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The length that 95 % of the strands do not pass, and the largest side of the bounds.
struct Extent {
  double length = 0, width = 0;
};
Extent extent(const Groom& groom) {
  std::vector<double> lengths(groom.strand_count());
  for (std::size_t s = 0; s < lengths.size(); ++s) lengths[s] = strand_length(groom, s);
  Extent result;
  if (!lengths.empty()) {
    const auto at = lengths.begin() + std::ptrdiff_t(double(lengths.size() - 1) * 0.95);
    std::nth_element(lengths.begin(), at, lengths.end());
    result.length = *at;
  }
  const Bounds box = bounds(groom);
  const glm::dvec3 side = glm::dvec3(box.upper) - glm::dvec3(box.lower);
  result.width = std::max({side.x, side.y, side.z});
  return result;
}

struct Unit {
  const char* name;
  double metres;
};
// In the order in which they are preferred where several fit.
constexpr Unit k_units[] = {
    {"metres", 1}, {"centimetres", 0.01}, {"millimetres", 0.001}, {"inches", 0.0254}, {"feet", 0.3048}};

bool is_head_of_hair(const Extent& size, double metres) {
  const double length = size.length * metres, width = size.width * metres;
  return length >= 0.05 && length <= 1.2 && width >= 0.1 && width <= 2;
}

Result<void> require_size(const char* name, std::size_t size, std::size_t expected) {
  if (size == expected) return {};
  return internal_error(fmt::format("groom: {} has {} entries, expected {}", name, size, expected));
}

Result<void> require_optional_size(const char* name, std::size_t size, std::size_t expected) {
  return size == 0 ? Result<void>() : require_size(name, size, expected);
}

Result<void> validate_offsets(const Groom& groom) {
  if (groom.offsets.empty() || groom.offsets.front() != 0) return internal_error("groom: offsets must begin with 0");
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (groom.offsets[s + 1] <= groom.offsets[s])
      return internal_error(fmt::format("groom: offsets[{}] does not rise", s + 1));
  return require_size("positions", groom.positions.size(), groom.offsets.back());
}

Result<void> validate_numbers(const Groom& groom) {
  for (std::size_t v = 0; v < groom.positions.size(); ++v)
    if (!is_finite(groom.positions[v])) return internal_error(fmt::format("groom: positions[{}] is not finite", v));
  for (std::size_t v = 0; v < groom.radii.size(); ++v)
    if (!std::isfinite(groom.radii[v]) || groom.radii[v] < 0)
      return internal_error(fmt::format("groom: radii[{}] is not a finite number >= 0", v));
  return {};
}

Result<void> validate_attributes(const Groom& groom) {
  for (const auto& [name, attribute] : groom.attributes) {
    const bool per_strand = attribute.domain == Attribute::Domain::strand;
    const std::size_t count = per_strand ? groom.strand_count() : groom.vertex_count();
    CUTICLE_TRY(require_size(name.c_str(), attribute.values.size(), count * std::size_t(attribute.components)));
    for (float value : attribute.values)
      if (!std::isfinite(value)) return internal_error(fmt::format("groom: attribute {} is not finite", name));
  }
  return {};
}

}  // namespace

UnitGuess guess_units(const Groom& groom) {
  const Extent size = extent(groom);
  const std::string what =
      fmt::format("95 % of strands are at most {:.4g} units long, all within {:.4g} units", size.length, size.width);
  for (const Unit& unit : k_units)
    if (is_head_of_hair(size, unit.metres))
      return {unit.metres, fmt::format("{}: taken as {} ({:.3g} m long, {:.3g} m wide)", what, unit.name,
                                       size.length * unit.metres, size.width * unit.metres)};
  if (!(size.length > 0)) return {1, what + ": taken as metres, since strands without length say nothing"};
  const double metres = 0.3 / size.length;
  return {metres,
          fmt::format("{}: no usual unit gives a head of hair; scaled so that such a strand is 0.3 m long", what)};
}

void scale(Groom& groom, double factor) {
  for (glm::vec3& position : groom.positions) position = glm::vec3(glm::dvec3(position) * factor);
  for (float& radius : groom.radii) radius = float(double(radius) * factor);
}

Bounds bounds(const Groom& groom) {
  if (groom.positions.empty()) return {};
  Bounds box{groom.positions.front(), groom.positions.front()};
  for (const glm::vec3& position : groom.positions) {
    box.lower = glm::min(box.lower, position);
    box.upper = glm::max(box.upper, position);
  }
  return box;
}

double strand_length(const Groom& groom, std::size_t strand) {
  const std::span<const glm::vec3> points = groom.strand(strand);
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += glm::distance(glm::dvec3(points[i - 1]), glm::dvec3(points[i]));
  return length;
}

Result<void> validate(const Groom& groom) {
  CUTICLE_TRY(validate_offsets(groom));
  CUTICLE_TRY(require_size("radii", groom.radii.size(), groom.vertex_count()));
  CUTICLE_TRY(require_optional_size("root_uv", groom.root_uv.size(), groom.strand_count()));
  CUTICLE_TRY(require_optional_size("root_triangle", groom.root_triangle.size(), groom.strand_count()));
  CUTICLE_TRY(require_optional_size("root_barycentrics", groom.root_barycentrics.size(), groom.strand_count()));
  CUTICLE_TRY(validate_numbers(groom));
  return validate_attributes(groom);
}

std::vector<glm::vec3> tangents(const Groom& groom) {
  std::vector<glm::vec3> result;
  result.reserve(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::span<const glm::vec3> points = groom.strand(s);
    if (points.empty()) continue;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::vec3& before = points[i == 0 ? 0 : i - 1];
      const glm::vec3& after = points[std::min(i + 1, points.size() - 1)];
      result.push_back(vertex_tangent<float>(before, after, points.front(), points.back()));
    }
  }
  return result;
}

}  // namespace cuticle::strands
