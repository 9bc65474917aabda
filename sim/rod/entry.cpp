#include "sim/effect_parameters.h"
#include "sim/rod/rod.h"

namespace cuticle::sim::rod {
namespace {

constexpr std::string_view k_systems[] = {"N6", "N8"};

}  // namespace

void describe(registry::Members& members, Rod& rod) {
  members(rod.inner_step, inner_step_row(100));
  members(rod.max_substeps, k_max_substeps);
  members(rod.damping, k_damping);
  members(rod.young_modulus, "young_modulus", "Pa", 0, 1e20, "E of the fibre; 0: it does not bend back");
  members(rod.shear_modulus, "shear_modulus", "Pa", 0, 1e20, "G of the fibre; 0: it does not twist back");
  members(rod.fibre_radius, "fibre_radius", "m", 1e-6, 0.01,
          "of the fibre, or of as many as move as one: EI = E pi r^4 / 4, GJ = G pi r^4 / 2");
  members(rod.density, "density", "kg/m^3", 1, 1e5, "of the fibre");
  members(rod.sag_free, "sag_free",
          "the groom is combed under gravity: the natural shape is the one that gravity bends into the rest pose");
  members(
      rod.stiffen_at_most, "stiffen_at_most", "1", 1, 1e9,
      "with sag_free: a strand whose rest pose gravity would tip over gets the least factor on EI and GJ that makes it "
      "stable, up to this; 1: none does");
  members(rod.clamped_vertices, "clamped_vertices", 1, 2,
          "first vertices of a strand that the head carries; the rod is clamped at the last of them");
  members(rod.double_precision, chains::k_double_precision);
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Rod::name,
                .summary = "fibres that bend and twist with physical stiffness and cannot stretch: one Newton "
                           "step on bending and all lengths",
                .source = "Bergou et al. 2008 (frames, quasi-static twist); Mueller et al. "
                          "2012 (follow the leader)",
                .parameters = registry::table_of<Rod>(),
                .demands = k_solver_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = chains::one_dispatch},
      .create = create,
      .substeps = substeps_of<Rod>,
      .fuses_effects = true,
      .follows_skin = true};
  return effect;
}

}  // namespace cuticle::sim::rod
