#include "sim/solver.h"
#include "sim/strand_interaction/settings.h"

namespace cuticle::sim::strand_interaction {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "strand_interaction"};
constexpr std::string_view k_systems[] = {"H17"};
constexpr std::string_view k_after[] = {"exact", "rod"};

/// Sums, then what follows from them.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 2; }

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  members(settings.cell, "cell", "m", 1e-4, 10, "edge of the grid's cells: hair nearer than that meets");
  members(settings.smoothing, "smoothing", "1/s", 0, 1e4,
          "rate at which a vertex takes on the mean velocity around it");
  members(settings.pressure, "pressure", "m/s", 0, 1e4, "speed at which crowded hair drives itself apart; 0: none");
  members(settings.onset, "onset", "1", 0.01, 1000,
          "density at which pressure begins, over the groom's own at the vertex and at least its mean");
  members(settings.most_acceleration, "most_acceleration", "m/s^2", 0, 1e5, "what pressure gives at most");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Settings::name,
                .summary = "strand against strand by a grid of whole numbers: velocities smoothed, pressure above the "
                           "groom's own density",
                .source =
                    "Petrovic, Henne and Anderson 2005 (hair on a grid); Zhu and Bridson 2005 (particles and grid)",
                .parameters = registry::table_of<Settings>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches,
                .after = k_after},
      .acts_on_result = true};
  return effect;
}

}  // namespace cuticle::sim::strand_interaction
