#include "strands/groom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/finite.h"
#include "strands/tangent.glslh"

namespace cuticle::strands {

namespace {

/// Strands measured for guess_units, evenly spread over the groom: enough for a fit of 95 %, at no cost worth a name.
constexpr std::size_t k_measured_strands = 20000;

/// The length that 95 % of the measured strands do not pass, and the largest side of their bounds.
struct Extent {
  double length = 0, width = 0;
};
Extent extent(const Groom& groom) {
  const std::size_t step = 1 + groom.strand_count() / k_measured_strands;
  std::vector<double> lengths;
  Bounds box;
  for (std::size_t s = 0; s < groom.strand_count(); s += step) {
    lengths.push_back(strand_length(groom, s));
    if (s == 0 && groom.strand_size(s) > 0) box = {groom.positions.front(), groom.positions.front()};
    for (const glm::vec3& point : groom.strand(s)) box = {glm::min(box.lower, point), glm::max(box.upper, point)};
  }
  Extent result;
  if (!lengths.empty()) {
    const auto at = lengths.begin() + std::ptrdiff_t(double(lengths.size() - 1) * 0.95);
    std::nth_element(lengths.begin(), at, lengths.end());
    result.length = *at;
  }
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
  const std::span coordinates(reinterpret_cast<const float*>(groom.positions.data()), 3 * groom.vertex_count());
  const std::size_t bad = first_not_finite(coordinates);
  if (bad < coordinates.size()) return internal_error(fmt::format("groom: positions[{}] is not finite", bad / 3));
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
    if (!all_finite(attribute.values)) return internal_error(fmt::format("groom: attribute {} is not finite", name));
  }
  return {};
}

template <class T>
void append_where_both_have(std::vector<T>& values, const std::vector<T>& more) {
  if (values.empty() || more.empty())
    values.clear();
  else
    values.insert(values.end(), more.begin(), more.end());
}

/// Whether both grooms have the attribute in the same form.
bool same_form(const Attribute& a, const Attribute& b) { return a.domain == b.domain && a.components == b.components; }

void keep_common_attributes(Groom& groom, const Groom& part) {
  std::erase_if(groom.attributes, [&part](const auto& entry) {
    const auto other = part.attributes.find(entry.first);
    return other == part.attributes.end() || !same_form(entry.second, other->second);
  });
  for (auto& [name, attribute] : groom.attributes) {
    const std::vector<float>& more = part.attributes.at(name).values;
    attribute.values.insert(attribute.values.end(), more.begin(), more.end());
  }
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
  if (factor == 1) return;
  const std::span coordinates(reinterpret_cast<float*>(groom.positions.data()), 3 * groom.vertex_count());
  for (float& coordinate : coordinates) coordinate = float(double(coordinate) * factor);
  for (float& radius : groom.radii) radius = float(double(radius) * factor);
}

void append(Groom& groom, const Groom& part) {
  const std::uint32_t first = groom.offsets.back();
  for (std::size_t s = 1; s < part.offsets.size(); ++s) groom.offsets.push_back(first + part.offsets[s]);
  groom.positions.insert(groom.positions.end(), part.positions.begin(), part.positions.end());
  groom.radii.insert(groom.radii.end(), part.radii.begin(), part.radii.end());
  append_where_both_have(groom.root_uv, part.root_uv);
  append_where_both_have(groom.root_triangle, part.root_triangle);
  append_where_both_have(groom.root_barycentrics, part.root_barycentrics);
  keep_common_attributes(groom, part);
}

Bounds bounds(const Groom& groom) {
  if (groom.positions.empty()) return {};
  // Four points at a time, whose twelve coordinates the compiler widens with vectors.
  constexpr std::size_t lanes = 12;
  const std::span numbers(reinterpret_cast<const float*>(groom.positions.data()), 3 * groom.vertex_count());
  std::array<float, lanes> lower, upper;
  for (std::size_t k = 0; k < lanes; ++k) lower[k] = upper[k] = numbers[k % 3];
  std::size_t i = 0;
  for (; i + lanes <= numbers.size(); i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) {
      lower[k] = std::min(lower[k], numbers[i + k]);
      upper[k] = std::max(upper[k], numbers[i + k]);
    }
  Bounds box{groom.positions.back(), groom.positions.back()};
  for (std::size_t k = 0; k < lanes; ++k) {
    box.lower[int(k % 3)] = std::min(box.lower[int(k % 3)], lower[k]);
    box.upper[int(k % 3)] = std::max(box.upper[int(k % 3)], upper[k]);
  }
  for (; i < numbers.size(); ++i) {
    box.lower[int(i % 3)] = std::min(box.lower[int(i % 3)], numbers[i]);
    box.upper[int(i % 3)] = std::max(box.upper[int(i % 3)], numbers[i]);
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
