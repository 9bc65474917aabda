#pragma once
// Private to study/motion and study/mechanics: an effect's parameters from text.
#include <string>

#include "sim/solver.h"

namespace cuticle::study {

/// Of a solver or effect by its name, name=value,name=value over the defaults. Errors: as sim::find_effect and
/// registry::parse_assignments.
inline Result<registry::ParameterValues> effect_values(std::string_view name, const std::string& settings) {
  CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(name));
  return registry::parse_assignments(effect->entry.parameters, settings);
}

}  // namespace cuticle::study
