#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::strand_interaction {
namespace {

constexpr registry::Parameter k_parameters[] = {
    real_parameter("cell", "m", 1e-4, 10, "0.02", "edge of the grid's cells: hair nearer than that meets"),
    real_parameter("smoothing", "1/s", 0, 1e4, "4", "rate at which a vertex takes on the mean velocity around it"),
    real_parameter("pressure", "m/s", 0, 1e4, "0.3", "speed at which crowded hair drives itself apart; 0: none"),
    real_parameter("onset", "1", 0.01, 1000, "1",
                   "density at which pressure begins, over the groom's own at the vertex and at least its mean"),
    real_parameter("most_acceleration", "m/s^2", 0, 1e5, "50", "what pressure gives at most"),
};
constexpr std::string_view k_demands[] = {"simulation", "strand_interaction"};
constexpr std::string_view k_systems[] = {"H17"};
constexpr std::string_view k_after[] = {"exact", "rod"};

/// Sums, then what follows from them.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 2; }

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "strand_interaction",
                .summary = "strand against strand by a grid of whole numbers: velocities smoothed, pressure above the "
                           "groom's own density",
                .source =
                    "Petrovic, Henne and Anderson 2005 (hair on a grid); Zhu and Bridson 2005 (particles and grid)",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches,
                .after = k_after},
      .acts_on_result = true};
  return effect;
}

}  // namespace cuticle::sim::strand_interaction
