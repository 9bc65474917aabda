#include "sim/chains/chain_parameters.h"
#include "sim/rod/rod.h"

namespace cuticle::sim::rod {
namespace {

constexpr registry::Parameter k_parameters[] = {
    chains::k_inner_step,
    k_max_substeps,
    k_damping,
    real_parameter("young_modulus", "Pa", 0, 1e20, "3.9e9", "E of the fibre; 0: it does not bend back"),
    real_parameter("shear_modulus", "Pa", 0, 1e20, "0.9e9", "G of the fibre; 0: it does not twist back"),
    real_parameter("fibre_radius", "m", 1e-6, 0.01, "3.5e-5",
                   "of the fibre, or of as many as move as one: EI = E pi r^4 / 4, GJ = G pi r^4 / 2"),
    real_parameter("density", "kg/m^3", 1, 1e5, "1300", "of the fibre"),
    flag_parameter(
        "sag_free", "true",
        "the groom is combed under gravity: the natural shape is the one that gravity bends into the rest pose"),
    clamped_vertices("1", "first vertices of a strand that the head carries; the rod is clamped at the last of them"),
    chains::k_double_precision,
};
constexpr std::string_view k_systems[] = {"N6", "N8"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "rod",
                .summary = "fibres that bend and twist with physical stiffness and cannot stretch: one Newton "
                           "step on bending and all lengths",
                .source = "Bergou et al. 2008 (frames, quasi-static twist); Mueller et al. "
                          "2012 (follow the leader)",
                .parameters = k_parameters,
                .demands = k_solver_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = chains::one_dispatch},
      .create = create,
      .substeps = chains::substeps,
      .fuses_effects = true,
      .follows_skin = true};
  return effect;
}

}  // namespace cuticle::sim::rod
