#pragma once
// Clumped strands that the tests of both halves share.
#include "sim/classic/test_strands.h"

namespace cuticle::sim::testing {

inline EffectBlocks clumps_alone(const std::string& assignments = {}) {
  return {{"clumping", settings_of("clumping", assignments)}};
}
inline EffectBlocks gravity_and_clumps(const std::string& assignments = {}) {
  EffectBlocks effects = clumps_alone(assignments);
  effects["gravity"] = settings_of("gravity");
  return effects;
}
/// The groom's attribute: one number per strand.
inline void set_clumps(strands::Groom& groom, std::vector<float> numbers) {
  groom.attributes["clump"] = {strands::Attribute::Domain::strand, 1, std::move(numbers)};
}
/// Without stiffness, drag and shape, on which nothing but the effects acts.
inline std::string limp(std::string_view solver) {
  return solver == "rod" ? "damping=0,young_modulus=0,shear_modulus=0,sag_free=false" : k_free;
}

}  // namespace cuticle::sim::testing
