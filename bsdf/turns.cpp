#include "bsdf/turns.h"

#include <algorithm>

#include "core/registry/members.h"

namespace cuticle::bsdf {
namespace {

/// What models with flat cross-sections have in common.
struct Flatness {
  double aspect = 1;
};
void describe(registry::Members& members, Flatness& p) {
  members(p.aspect, "aspect", "1", 0.2, 2, "minor over major axis of the cross-section");
}
struct Turns {
  std::int64_t turns = 0;
};
void describe(registry::Members& members, Turns& p) { members(p.turns, turns_parameter); }

template <class T>
bool has(const registry::ParameterValues& values) {
  return std::ranges::all_of(registry::table_of<T>(),
                             [&](const registry::Parameter& row) { return values.all().contains(row.name); });
}

}  // namespace

bool is_turned_by_viewer(const registry::ParameterValues& values) {
  if (!has<Flatness>(values) || registry::from_values<Flatness>(values).aspect == 1) return false;
  return !has<Turns>(values) || registry::from_values<Turns>(values).turns == 0;
}

registry::ParameterValues over_turns(const registry::ParameterValues& values, int count) {
  registry::ParameterValues averaged = values;
  if (!is_turned_by_viewer(values) || !has<Turns>(values)) return averaged;
  averaged.set(turns_parameter.name, std::int64_t(count));
  return averaged;
}

}  // namespace cuticle::bsdf
