#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::sleep {
namespace {

constexpr registry::Parameter k_parameters[] = {
    real_parameter("speed", "m/s", 0, 100, "0.002", "a strand of which no vertex is faster is at rest"),
    real_parameter("time", "s", 1e-3, 1e4, "0.5", "rest after which it sleeps"),
};
constexpr std::string_view k_demands[] = {"simulation", "sleep"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "sleep",
                .summary = "strands at rest are left as they are until head, colliders, air or weight change",
                .source = "as engines of rigid bodies do",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate}};
  return effect;
}

}  // namespace cuticle::sim::sleep
