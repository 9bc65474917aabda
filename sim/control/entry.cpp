#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::control {
namespace {

constexpr registry::Parameter k_parameters[] = {
    real_parameter("root", "1", 0, 1, "0.5", "weight of the authored motion at the root ..."),
    real_parameter("tip", "1", 0, 1, "0", "... and at the tip, linear in arc length between"),
    real_parameter("begin", "s", 0, 1e6, "0", "time at which the whole weight is reached"),
    real_parameter("end", "s", 0, 1e6, "1e6", "time from which it falls again"),
    real_parameter("fade", "s", 0, 1e6, "0.5", "time that the rise before `begin` and the fall after `end` take"),
};
constexpr std::string_view k_demands[] = {"simulation", "control"};
constexpr std::string_view k_systems[] = {"N3"};
constexpr std::string_view k_after[] = {"classic", "colliders", "exact", "rod"};

/// The blend of all vertices, once per frame.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "control",
                .summary = "a weight per hair, vertex and time between simulated and authored motion",
                .source = "Nalu, GPU Gems 2, chapter 23, manual control",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches,
                .after = k_after},
      .acts_on_result = true};
  return effect;
}

}  // namespace cuticle::sim::control
