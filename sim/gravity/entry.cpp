#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::gravity {
namespace {

constexpr registry::Parameter k_parameters[] = {
    vector_parameter("acceleration", "m/s^2", -1000, 1000, "0/-9.80665/0", "acceleration vector in world space, x/y/z"),
};
constexpr std::string_view k_demands[] = {"simulation", "gravity"};
constexpr std::string_view k_systems[] = {"G8"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "gravity",
                .summary = "a constant acceleration, folded into the integration (no dispatch of its own)",
                .source = "standard gravity 9.80665 m/s^2, CGPM 1901",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems}};
  return effect;
}

}  // namespace cuticle::sim::gravity
