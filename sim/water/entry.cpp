#include "sim/solver.h"
#include "sim/water/water.h"

namespace cuticle::sim::water {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "water"};
constexpr std::string_view k_systems[] = {"N21"};

PushOverTime push(const registry::ParameterValues& effect) {
  return [current = current(registry::from_values<Water>(effect))](double time) { return push_at(current, time); };
}
double weight_left(const registry::ParameterValues& effect) {
  return 1 - buoyancy(registry::from_values<Water>(effect));
}

}  // namespace

void describe(registry::Members& members, Water& water) {
  members(water.density, "density", "kg/m^3", 0, 20000,
          "of the water: what the hair displaces carries that share of its weight");
  members(water.fibre_density, "fibre_density", "kg/m^3", 1, 20000, "of the hair, wet");
  members(water.current, "current", "m/s", -20, 20, "velocity of the water in world space, x/y/z");
  members(water.drag, "drag", "1/s", 0, 1000, "rate at which a free fibre takes on the water's velocity");
  members(water.swell, "swell", "1", 0, 100, "share of the current by which it swings");
  members(water.swell_frequency, "swell_frequency", "1/s", 0, 100, "swings in a second");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Water::name,
                .summary =
                    "under water: buoyancy, drag and a swelling current, folded into every solver (no dispatch of "
                    "its own)",
                .source = "Archimedes; linear drag by length as in wind",
                .parameters = registry::table_of<Water>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems},
      .push = push,
      .weight_left = weight_left};
  return effect;
}

}  // namespace cuticle::sim::water
