#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::water {
namespace {

constexpr registry::Parameter k_parameters[] = {
    real_parameter("density", "kg/m^3", 0, 20000, "1000",
                   "of the water: what the hair displaces carries that share of its weight"),
    real_parameter("fibre_density", "kg/m^3", 1, 20000, "1300", "of the hair, wet"),
    vector_parameter("current", "m/s", -20, 20, "0.1/0/0", "velocity of the water in world space, x/y/z"),
    real_parameter("drag", "1/s", 0, 1000, "12", "rate at which a free fibre takes on the water's velocity"),
    real_parameter("swell", "1", 0, 100, "1", "share of the current by which it swings"),
    real_parameter("swell_frequency", "1/s", 0, 100, "0.25", "swings in a second"),
};
constexpr std::string_view k_demands[] = {"simulation", "water"};
constexpr std::string_view k_systems[] = {"N21"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "water",
                .summary =
                    "under water: buoyancy, drag and a swelling current, folded into every solver (no dispatch of "
                    "its own)",
                .source = "Archimedes; linear drag by length as in wind",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems}};
  return effect;
}

}  // namespace cuticle::sim::water
