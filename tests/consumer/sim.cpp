// A strand that falls for a frame, by a solver of the module `sim`.
#include <cstdio>

#include <cuticle/sim/solver.h>

int main() {
  namespace sim = cuticle::sim;
  cuticle::strands::Groom groom;
  groom.positions = {{0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}};
  groom.offsets = {0, 3};
  groom.radii = {3e-5f, 3e-5f, 3e-5f};
  const auto exact = sim::find_effect("exact"), gravity = sim::find_effect("gravity");
  if (!exact || !gravity) return 1;
  const auto defaults = [](const sim::Effect& effect) {
    return cuticle::registry::default_values(effect.entry.parameters);
  };
  const auto values = cuticle::registry::parse_assignments((*exact)->entry.parameters, "sag_free=false");
  const auto solver = (*exact)->create(groom, values.value(), {{"gravity", defaults(**gravity)}});
  if (!solver || !(*solver)->advance({})) return 1;
  const auto state = (*solver)->state();
  std::printf("%.6f m\n", state.value().positions[2].y);
  return state.value().positions[2].y < 0 ? 0 : 1;
}
