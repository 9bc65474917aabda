#include "sim/sleep/sleep.h"

namespace cuticle::sim::sleep {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "sleep"};

}  // namespace

void describe(registry::Members& members, Settings& sleep) {
  members(sleep.speed, "speed", "m/s", 0, 100, "a strand of which no vertex is faster is at rest");
  members(sleep.time, "time", "s", 1e-3, 1e4, "rest after which it sleeps");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Settings::name,
                .summary = "strands at rest are left as they are until head, colliders, air or weight change",
                .source = "as engines of rigid bodies do",
                .parameters = registry::table_of<Settings>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate}};
  return effect;
}

}  // namespace cuticle::sim::sleep
