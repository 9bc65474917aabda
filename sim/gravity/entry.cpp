#include <cuticle/sim/solver.h>

namespace cuticle::sim::gravity {
namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    {.name = "acceleration", .type = ParameterType::rgb, .unit = "m/s^2", .minimum = -1000, .maximum = 1000,
     .default_text = "0/-9.80665/0", .summary = "acceleration vector in world space, x/y/z"},
};
constexpr std::string_view k_demands[] = {"simulation", "gravity"};
constexpr std::string_view k_systems[] = {"G8"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect, .name = "gravity",
                .summary = "a constant acceleration, folded into the integration (no dispatch of its own)",
                .source = "standard gravity 9.80665 m/s^2, CGPM 1901", .parameters = k_parameters, .demands = k_demands,
                .stage = registry::Stage::simulate, .systems = k_systems}};
  return effect;
}

}  // namespace cuticle::sim::gravity
