#include <cuticle/sim/solver.h>

namespace cuticle::sim::water {
namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    {.name = "density",
     .type = ParameterType::real,
     .unit = "kg/m^3",
     .minimum = 0,
     .maximum = 20000,
     .default_text = "1000",
     .summary = "of the water: what the hair displaces carries that share of its weight"},
    {.name = "fibre_density",
     .type = ParameterType::real,
     .unit = "kg/m^3",
     .minimum = 1,
     .maximum = 20000,
     .default_text = "1300",
     .summary = "of the hair, wet"},
    {.name = "current",
     .type = ParameterType::rgb,
     .unit = "m/s",
     .minimum = -20,
     .maximum = 20,
     .default_text = "0.1/0/0",
     .summary = "velocity of the water in world space, x/y/z"},
    {.name = "drag",
     .type = ParameterType::real,
     .unit = "1/s",
     .minimum = 0,
     .maximum = 1000,
     .default_text = "12",
     .summary = "rate at which a free fibre takes on the water's velocity"},
    {.name = "swell",
     .type = ParameterType::real,
     .unit = "1",
     .minimum = 0,
     .maximum = 100,
     .default_text = "1",
     .summary = "share of the current by which it swings"},
    {.name = "swell_frequency",
     .type = ParameterType::real,
     .unit = "1/s",
     .minimum = 0,
     .maximum = 100,
     .default_text = "0.25",
     .summary = "swings in a second"},
};
constexpr std::string_view k_demands[] = {"simulation", "water"};
constexpr std::string_view k_systems[] = {"N21"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "water",
                .summary = "under water: buoyancy, drag and a swelling current, folded into exact and rod (no dispatch of "
                           "its own)",
                .source = "Archimedes; linear drag by length as in wind",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems}};
  return effect;
}

}  // namespace cuticle::sim::water
