// Numbers per vertex that strands are coloured by.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "shadows/method.h"
#include "sim/solver.h"
#include "strands/lod/spread_order.h"
#include "viz/strands/states.h"

namespace cuticle::viz {
namespace {

using strands::Groom;

/// What is known of an array by its name.
struct KnownArray {
  std::string_view title;
  bool diverging = false;
  double neutral = 0;
};
const std::map<std::string_view, KnownArray>& known_arrays() {
  static const std::map<std::string_view, KnownArray> known = {
      {"stretch", {"stretch [length / rest length]", true, 1}},
      {"tension", {"tension over mass per length [m^2/s^2]"}},
      {"curvature", {"curvature [1/m]"}},
      {"velocity", {"speed [m/s]"}},
      {"guard_fired", {"guard fired: 1 where the strand was reset"}},
      {"radius", {"radius [m]"}}};
  return known;
}

/// A vertex attribute, or a strand's for all its vertices; of several components the length.
std::vector<float> spread(const Groom& groom, const strands::Attribute& attribute) {
  const auto length = [&](std::size_t item) {
    double square = 0;
    for (int c = 0; c < attribute.components; ++c) {
      const float value = attribute.values[item * std::size_t(attribute.components) + std::size_t(c)];
      if (attribute.components == 1) return value;
      square += double(value) * double(value);
    }
    return float(std::sqrt(square));
  };
  std::vector<float> values(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v)
      values[v] = length(attribute.domain == strands::Attribute::Domain::vertex ? v : s);
  return values;
}

/// Torsion: how fast the curve's plane turns along the strand, 1/m, signed by the right hand.
std::vector<float> twists(const Groom& groom) {
  std::vector<float> values(groom.vertex_count(), 0.0F);
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const auto points = groom.strand(s);
    for (std::size_t k = 1; k + 2 < points.size(); ++k) {
      const glm::dvec3 a = points[k] - points[k - 1], b = points[k + 1] - points[k], c = points[k + 2] - points[k + 1];
      const glm::dvec3 first = glm::cross(a, b), second = glm::cross(b, c);
      const double length = glm::length(b);
      if (length < 1e-12 || glm::length(first) < 1e-9 * length * length) continue;
      const double angle = std::atan2(glm::dot(glm::cross(first, second), b) / length, glm::dot(first, second));
      values[groom.offsets[s] + k] = float(angle / length);
    }
  }
  return values;
}

std::vector<float> per_strand(const Groom& groom, const std::function<float(std::size_t)>& value) {
  std::vector<float> values(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    std::fill(values.begin() + groom.offsets[s], values.begin() + groom.offsets[s + 1], value(s));
  return values;
}

/// The share of the strands at which a level of detail keeps each: strands::spread_order.
std::vector<float> levels(const Groom& groom) {
  const auto order = strands::spread_order(strands::shapes_of(groom));
  std::vector<float> rank(groom.strand_count());
  for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = float(k + 1) / float(order.size());
  return per_strand(groom, [&](std::size_t s) { return rank[s]; });
}

std::vector<float> sleeping(const Groom& groom, const Groom* before) {
  return per_strand(groom, [&](std::size_t s) {
    if (!before || before->offsets != groom.offsets) return 0.0F;
    const auto now = groom.strand(s), then = before->strand(s);
    return std::equal(now.begin(), now.end(), then.begin()) ? 1.0F : 0.0F;
  });
}

/// Distance to the nearest collider, mm, below 0 within: of the run's own by its file, and of those given.
ColoredStrands contacts(const Groom& groom, std::span<const Sphere> given) {
  std::vector<sim::PlacedCollider> colliders;
  for (const Sphere& sphere : given) colliders.push_back({sphere, {}});
  std::vector<float> values = sim::distances(colliders, groom.positions);
  if (const auto own = groom.attributes.find("contact"); own != groom.attributes.end()) {
    const std::vector<float> of_run = spread(groom, own->second);
    if (values.empty()) values = of_run;
    for (std::size_t v = 0; v < values.size(); ++v) values[v] = std::min(values[v], of_run[v]);
  }
  for (float& value : values) value *= 1e3F;
  return {std::move(values), "distance to the nearest collider [mm]", true, 0, 10.0};
}

Result<std::vector<float>> transmittances(const Groom& groom, const StrandColoring& coloring, std::string_view method) {
  CUTICLE_ASSIGN(const shadows::Method* found, shadows::find_method(method));
  const auto values = method == "truth" ? registry::parse_assignments(found->entry.parameters, "rays=64")
                                        : registry::parse_assignments(found->entry.parameters, "");
  if (!values) return values.error();
  std::vector<std::uint32_t> strands(groom.vertex_count()), vertices(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v)
      strands[v] = std::uint32_t(s), vertices[v] = std::uint32_t(v);
  const shadows::Casters casters{&groom, coloring.alpha, glm::normalize(coloring.to_light)};
  CUTICLE_ASSIGN(shadows::Transmittance found_values,
                 found->evaluate(casters, {groom.positions, strands, {}, vertices}, *values));
  return std::move(found_values.values);
}

Result<ColoredStrands> shadow_error(const Groom& groom, const StrandColoring& coloring) {
  const std::string method = coloring.name.substr(coloring.name.find(':') + 1);
  CUTICLE_ASSIGN(std::vector<float> values, transmittances(groom, coloring, method));
  CUTICLE_ASSIGN(const std::vector<float> truth, transmittances(groom, coloring, "truth"));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= truth[i];
  return ColoredStrands{std::move(values), fmt::format("error of {}: its T less the true T", method), true, 0};
}

Error unknown_color(const Groom& groom, const std::string& name) {
  std::vector<std::string> known = {"arc_length", "curvature", "twist",         "strand",      "level",
                                    "asleep",     "contact",   "transmittance", "error:METHOD"};
  for (const auto& [attribute, values] : groom.attributes) known.push_back(attribute);
  return usage_error(fmt::format("--color {}: not known; here: {}", name, fmt::join(known, ", ")),
                     "tension is written by runs of the solvers exact and rod, contact by runs with colliders");
}

ColoredStrands of_attribute(const Groom& groom, const std::string& name) {
  const auto known = known_arrays().find(name);
  ColoredStrands colored{spread(groom, groom.attributes.at(name)), name};
  if (known != known_arrays().end()) {
    colored.title = known->second.title;
    colored.diverging = known->second.diverging;
    colored.neutral = known->second.neutral;
  }
  return colored;
}

}  // namespace

std::vector<float> arc_lengths(const Groom& groom) {
  std::vector<float> lengths(groom.vertex_count(), 0.0F);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = groom.offsets[s] + 1; v < groom.offsets[s + 1]; ++v)
      lengths[v] = lengths[v - 1] + glm::distance(groom.positions[v], groom.positions[v - 1]);
  return lengths;
}

Result<ColoredStrands> color_strands(const Groom& groom, const StrandColoring& coloring, const Groom* before) {
  std::string name = coloring.name;
  if (name.empty()) name = groom.attributes.contains("stretch") ? "stretch" : "arc_length";
  if (name == "speed") name = "velocity";
  if (name == "contact" && (groom.attributes.contains(name) || !coloring.colliders.empty()))
    return contacts(groom, coloring.colliders);
  if (groom.attributes.contains(name)) return of_attribute(groom, name);
  if (name == "arc_length") return ColoredStrands{arc_lengths(groom), "arc length from the root [m]"};
  if (name == "curvature") return ColoredStrands{sim::curvature(groom, groom.positions), "curvature [1/m]"};
  if (name == "twist") return ColoredStrands{twists(groom), "twist: torsion of the curve [rad/m]", true, 0};
  if (name == "strand")
    return ColoredStrands{per_strand(groom, [](std::size_t s) { return float(s); }), "strand, from 0"};
  if (name == "level")
    return ColoredStrands{levels(groom), "level of detail: share of strands from which on it is drawn"};
  if (name == "asleep")
    return ColoredStrands{sleeping(groom, before), "asleep: 1 where nothing moved since the frame before"};
  if (name == "transmittance") {
    CUTICLE_ASSIGN(std::vector<float> values, transmittances(groom, coloring, "deep_opacity"));
    return ColoredStrands{std::move(values), "transmittance of the light (deep opacity map)"};
  }
  if (name.starts_with("error:")) return shadow_error(groom, coloring);
  return unknown_color(groom, name);
}

ColorScale scale_of(const ColoredStrands& colored) {
  if (!colored.diverging) return sequential_scale(colored.values, colored.title);
  ColorScale scale = diverging_scale(colored.values, colored.neutral, colored.title);
  const double least = 1e-4 * std::abs(colored.neutral);  // rounding is no stretch
  scale.lower = std::min(scale.lower, colored.neutral - least);
  scale.upper = std::max(scale.upper, colored.neutral + least);
  if (colored.reach) {
    scale.lower = std::max(scale.lower, colored.neutral - *colored.reach);
    scale.upper = std::min(scale.upper, colored.neutral + *colored.reach);
  }
  return scale;
}

}  // namespace cuticle::viz
