#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::wind {
namespace {

constexpr registry::Parameter k_parameters[] = {
    vector_parameter("velocity", "m/s", -100, 100, "2/0/0", "of the air in world space, x/y/z"),
    real_parameter("drag", "1/s", 0, 1000, "3", "rate at which a free fibre takes on the air's velocity"),
    real_parameter("gust", "1", 0, 10, "0.5", "share of the velocity by which it swings"),
    real_parameter("gust_frequency", "1/s", 0, 100, "0.7", "swings in a second"),
};
constexpr std::string_view k_demands[] = {"simulation", "wind"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "wind",
                .summary = "uniform, gusting air: linear drag, folded into every solver (no dispatch of its own)",
                .source = "linear drag by length; the resting chain is a straight line at tan phi = drag U / g",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate}};
  return effect;
}

}  // namespace cuticle::sim::wind
