#pragma once
// Strands that the tests of both halves share.
#include <random>

#include "sim/classic/test_strands.h"
#include "sim/strand_interaction/strand_interaction.h"

namespace cuticle::sim::testing {

/// Parallel strands of 0.2 m, evenly spread over a disc of this radius (metres).
inline strands::Groom bundle(int count, double radius) {
  strands::Groom groom;
  for (int s = 0; s < count; ++s) {
    const double away = radius * std::sqrt((s + 0.5) / count), angle = 2.399963229728653 * s;
    add_straight(groom, {away * std::cos(angle), 0, away * std::sin(angle)}, {0, -1, 0}, uniform_segments(16, 0.2));
  }
  return groom;
}

inline std::vector<glm::vec3> random_vectors(std::size_t count, float most) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> part(-most, most);
  std::vector<glm::vec3> vectors(count);
  for (glm::vec3& v : vectors) v = {part(random), part(random), part(random)};
  return vectors;
}

inline strand_interaction::Settings interaction_settings(const std::string& assignments = {}) {
  return registry::from_values<strand_interaction::Settings>(settings_of("strand_interaction", assignments));
}
inline EffectBlocks gravity_and_interaction(const std::string& assignments = {}) {
  return {{"gravity", settings_of("gravity")}, {"strand_interaction", settings_of("strand_interaction", assignments)}};
}

}  // namespace cuticle::sim::testing
