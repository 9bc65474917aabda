#include "sim/solver.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::sim {

namespace {
/// Of a strand's length: files have segments of 1e-7 m, of which the length is rounding. Shorter ones do not stretch.
constexpr double k_negligible_segment = 1e-4;
}  // namespace

std::vector<float> stretch(const strands::Groom& rest, std::span<const glm::vec3> positions) {
  CUTICLE_EXPECT(positions.size() == rest.vertex_count(), "one position per vertex of the rest pose");
  std::vector<float> ratios(positions.size(), 1.f);
  for (std::size_t s = 0; s < rest.strand_count(); ++s) {
    double total = 0;
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i)
      total += double(glm::distance(rest.positions[i - 1], rest.positions[i]));
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i) {
      const float length = glm::distance(rest.positions[i - 1], rest.positions[i]);
      if (double(length) > k_negligible_segment * total)
        ratios[i] = glm::distance(positions[i - 1], positions[i]) / length;
    }
  }
  return ratios;
}

namespace {

/// 2 tan(a / 2) = 2 |sum across| / (1 + cosine) of the angle between two segments, over their mean length.
float curvature_between(const glm::dvec3& before, const glm::dvec3& after) {
  const double shorter = std::min(glm::length(before), glm::length(after));
  if (!(shorter > 0)) return 0;
  const glm::dvec3 a = glm::normalize(before), b = glm::normalize(after);
  const double across = glm::length(glm::cross(a, b)), along = std::max(1 + glm::dot(a, b), 1e-12);
  return static_cast<float>(std::min(1e6, 4 * across / (along * (glm::length(before) + glm::length(after)))));
}

}  // namespace

std::vector<float> curvature(const strands::Groom& rest, std::span<const glm::vec3> positions) {
  CUTICLE_EXPECT(positions.size() == rest.vertex_count(), "one position per vertex of the rest pose");
  std::vector<float> values(positions.size(), 0.f);
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s] + 1; i + 1 < rest.offsets[s + 1]; ++i)
      values[i] = curvature_between(glm::dvec3(positions[i]) - glm::dvec3(positions[i - 1]),
                                    glm::dvec3(positions[i + 1]) - glm::dvec3(positions[i]));
  return values;
}

Result<const Effect*> find_effect(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Effect* effect : effects()) {
    if (effect->entry.name == name) return effect;
    known.push_back(effect->entry.name);
  }
  const std::string nearest = registry::nearest_name(name, known);
  return usage_error(fmt::format("effect '{}' is not known", name),
                     nearest.empty() ? "`cuticle effects` lists them" : fmt::format("did you mean '{}'?", nearest));
}

Pushes effect_pushes(const EffectBlocks& blocks) {
  Pushes pushes;
  for (const Effect* effect : effects()) {
    const auto block = blocks.find(effect->entry.name);
    if (block == blocks.end()) continue;
    if (effect->push) pushes.over_time.push_back(effect->push(block->second));
    if (effect->weight_left) pushes.weight_left *= effect->weight_left(block->second);
  }
  return pushes;
}

}  // namespace cuticle::sim
