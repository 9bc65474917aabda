#include <cuticle/sim/solver.h>

namespace cuticle::sim::wind {
namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    {.name = "velocity",
     .type = ParameterType::rgb,
     .unit = "m/s",
     .minimum = -100,
     .maximum = 100,
     .default_text = "2/0/0",
     .summary = "of the air in world space, x/y/z"},
    {.name = "drag",
     .type = ParameterType::real,
     .unit = "1/s",
     .minimum = 0,
     .maximum = 1000,
     .default_text = "3",
     .summary = "rate at which a free fibre takes on the air's velocity"},
    {.name = "gust",
     .type = ParameterType::real,
     .unit = "1",
     .minimum = 0,
     .maximum = 10,
     .default_text = "0.5",
     .summary = "share of the velocity by which it swings"},
    {.name = "gust_frequency",
     .type = ParameterType::real,
     .unit = "1/s",
     .minimum = 0,
     .maximum = 100,
     .default_text = "0.7",
     .summary = "swings in a second"},
};
constexpr std::string_view k_demands[] = {"simulation", "wind"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {
          .kind = registry::EntryKind::effect,
          .name = "wind",
          .summary = "uniform, gusting air: linear drag, folded into the integration of exact (no dispatch of its own)",
          .source = "linear drag by length; the resting chain is a straight line at tan phi = drag U / g",
          .parameters = k_parameters,
          .demands = k_demands,
          .stage = registry::Stage::simulate}};
  return effect;
}

}  // namespace cuticle::sim::wind
