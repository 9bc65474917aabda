#include "bsdf/turns.h"

namespace cuticle::bsdf {

bool is_turned_by_viewer(const registry::ParameterValues& values) {
  const auto& known = values.all();
  if (!known.contains("aspect") || values.real("aspect") == 1) return false;
  return !known.contains("turns") || values.integer("turns") == 0;
}

registry::ParameterValues over_turns(const registry::ParameterValues& values, int count) {
  registry::ParameterValues averaged = values;
  if (is_turned_by_viewer(values) && values.all().contains("turns")) averaged.set("turns", std::int64_t(count));
  return averaged;
}

}  // namespace cuticle::bsdf
