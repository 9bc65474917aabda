#include "sim/chains/chain_parameters.h"
#include "sim/exact/exact.h"

namespace cuticle::sim::exact {
namespace {

constexpr registry::Parameter k_parameters[] = {
    chains::k_inner_step, k_max_substeps, k_damping,          k_shape_stiffness,
    k_shape_tip,          k_sag_free,     k_clamped_vertices, chains::k_double_precision,
};
constexpr std::string_view k_systems[] = {"N6", "N8"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {.entry = {.kind = registry::EntryKind::effect,
                                          .name = "exact",
                                          .summary = "chains of rigid links: one Newton step on all lengths, then "
                                                     "every link follows its parent at its length",
                                          .source = "Han and Harada 2012 (direct lengths); Mueller et al. 2012 (follow "
                                                    "the leader); BDF2, Curtiss and Hirschfelder 1952",
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

}  // namespace cuticle::sim::exact
