#include <cuticle/sim/solver.h>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::sim {

std::vector<float> stretch(const strands::Groom& rest, std::span<const glm::vec3> positions) {
  CUTICLE_EXPECT(positions.size() == rest.vertex_count(), "one position per vertex of the rest pose");
  std::vector<float> ratios(positions.size(), 1.f);
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i) {
      const float length = glm::distance(rest.positions[i - 1], rest.positions[i]);
      if (length > 0) ratios[i] = glm::distance(positions[i - 1], positions[i]) / length;
    }
  return ratios;
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

}  // namespace cuticle::sim
