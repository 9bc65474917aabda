#include "sim/gravity/gravity.h"

namespace cuticle::sim::gravity {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "gravity"};
constexpr std::string_view k_systems[] = {"G8"};

}  // namespace

void describe(registry::Members& members, Gravity& gravity) {
  members(gravity.acceleration, "acceleration", "m/s^2", -1000, 1000, "acceleration vector in world space, x/y/z");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Gravity::name,
                .summary = "a constant acceleration, folded into the integration (no dispatch of its own)",
                .source = "standard gravity 9.80665 m/s^2, CGPM 1901",
                .parameters = registry::table_of<Gravity>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems}};
  return effect;
}

}  // namespace cuticle::sim::gravity
