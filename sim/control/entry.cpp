#include "sim/control/control.h"

namespace cuticle::sim::control {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "control"};
constexpr std::string_view k_systems[] = {"N3"};
constexpr std::string_view k_after[] = {"classic", "colliders", "exact", "rod"};

/// The blend of all vertices, once per frame.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace

void describe(registry::Members& members, Control& control) {
  members(control.root, "root", "1", 0, 1, "weight of the authored motion at the root ...");
  members(control.tip, "tip", "1", 0, 1, "... and at the tip, linear in arc length between");
  members(control.begin, "begin", "s", 0, 1e6, "time at which the whole weight is reached");
  members(control.end, "end", "s", 0, 1e6, "time from which it falls again");
  members(control.fade, "fade", "s", 0, 1e6, "time that the rise before `begin` and the fall after `end` take");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Control::name,
                .summary = "a weight per hair, vertex and time between simulated and authored motion",
                .source = "Nalu, GPU Gems 2, chapter 23, manual control",
                .parameters = registry::table_of<Control>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches,
                .after = k_after},
      .acts_on_result = true};
  return effect;
}

}  // namespace cuticle::sim::control
