#include "sim/clumping/settings.h"
#include "sim/solver.h"

namespace cuticle::sim::clumping {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "clumping"};
constexpr std::string_view k_systems[] = {"H9"};

/// The aims of all vertices, once a frame, before the substeps.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace

void describe(registry::Members& members, Settings& clumping) {
  members(clumping.rate, "rate", "1/s", 0, 1e9, "of the critically damped pull towards the place in the clump");
  members(clumping.tightness, "tightness", "1", 0, 1,
          "share of the distance from the guide at rest that is gone at the tip; 0: the distance is kept");
  members(clumping.profile, "profile", "1", 0.1, 8,
          "where a clump closes: tightness times (arc over length)^profile; below 1 near the root");
  members(clumping.noise, "noise", "1", 0, 1, "by what share of it at most a strand's tightness is less, by chance");
  members(clumping.strands_per_clump, "strands_per_clump", 1, 100000,
          "mean number of strands of a clump where the groom has no attribute 'clump'");
  members(clumping.seed, "seed", 0, 1e9, "of the chance that makes guides and noise");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Settings::name,
                .summary = "strands are pulled to their clump's guide strand, the nearer the farther from the root",
                .source = "clump scale, roundness and noise of HairWorks: docs/systems.md, H9",
                .parameters = registry::table_of<Settings>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches},
      .acts_on_result = true};
  return effect;
}

}  // namespace cuticle::sim::clumping
