#include "sim/solver.h"
#include "sim/wind/wind.h"

namespace cuticle::sim::wind {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "wind"};

PushOverTime push(const registry::ParameterValues& effect) {
  return [wind = registry::from_values<Wind>(effect)](double time) { return push_at(wind, time); };
}

}  // namespace

void describe(registry::Members& members, Wind& wind) {
  members(wind.velocity, "velocity", "m/s", -100, 100, "of the air in world space, x/y/z");
  members(wind.drag, "drag", "1/s", 0, 1000, "rate at which a free fibre takes on the air's velocity");
  members(wind.gust, "gust", "1", 0, 10, "share of the velocity by which it swings");
  members(wind.gust_frequency, "gust_frequency", "1/s", 0, 100, "swings in a second");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Wind::name,
                .summary = "uniform, gusting air: linear drag, folded into every solver (no dispatch of its own)",
                .source = "linear drag by length; the resting chain is a straight line at tan phi = drag U / g",
                .parameters = registry::table_of<Wind>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate},
      .push = push};
  return effect;
}

}  // namespace cuticle::sim::wind
