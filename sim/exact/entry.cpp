#include "sim/effect_parameters.h"
#include "sim/exact/exact.h"

namespace cuticle::sim::exact {
namespace {

constexpr std::string_view k_systems[] = {"N6", "N8"};

}  // namespace

void describe(registry::Members& members, Exact& exact) {
  members(exact.inner_step, inner_step_row(100));
  members(exact.max_substeps, k_max_substeps);
  members(exact.damping, k_damping);
  members(exact.shape_stiffness, k_shape_stiffness);
  members(exact.shape_tip, k_shape_tip);
  members(exact.sag_free, k_sag_free);
  members(exact.clamped_vertices, k_clamped_vertices);
  members(exact.double_precision, chains::k_double_precision);
}

const Effect& entry() {
  static const Effect effect = {.entry = {.kind = registry::EntryKind::effect,
                                          .name = Exact::name,
                                          .summary = "chains of rigid links: one Newton step on all lengths, then "
                                                     "every link follows its parent at its length",
                                          .source = "Han and Harada 2012 (direct lengths); Mueller et al. 2012 (follow "
                                                    "the leader); BDF2, Curtiss and Hirschfelder 1952",
                                          .parameters = registry::table_of<Exact>(),
                                          .demands = k_solver_demands,
                                          .stage = registry::Stage::simulate,
                                          .systems = k_systems,
                                          .dispatches = chains::one_dispatch},
                                .create = create,
                                .substeps = substeps_of<Exact>,
                                .fuses_effects = true,
                                .follows_skin = true};
  return effect;
}

}  // namespace cuticle::sim::exact
