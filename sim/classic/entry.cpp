#include "sim/classic/classic.h"
#include "sim/effect_parameters.h"

namespace cuticle::sim::classic {
namespace {

constexpr std::string_view k_orders[] = {"sequence", "red_black"};
constexpr std::string_view k_systems[] = {"N6", "N7", "N8", "H3", "H4", "H5", "H6"};

/// Integration and length constraints, once per substep.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return 2 * shape.substeps;
}

}  // namespace

void describe(registry::Members& members, Classic& classic) {
  members(classic.inner_step, inner_step_row(1));
  members(classic.max_substeps, k_max_substeps);
  members(classic.iterations, "iterations", 1, 1000, "sweeps over the length constraints per substep, root to tip");
  members(classic.sweep.order, "order", k_orders,
          "of a sweep: segments one after the other, or every other one at once, then the rest");
  members(classic.sweep.long_range, "long_range",
          "no vertex farther from the last carried one than the arc between them");
  members(classic.sweep.sphere_root, "sphere_root", "m", 0, 100,
          "no vertex farther from its rest place carried by the head than this at the root ...");
  members(classic.sweep.sphere_tip, "sphere_tip", "m", 0, 100,
          "... and this at the tip, linear between; both 0: no such spheres");
  members(classic.damping, k_damping);
  members(classic.shape_stiffness, k_shape_stiffness);
  members(classic.shape_tip, k_shape_tip);
  members(classic.sag_free, k_sag_free);
  members(classic.clamped_vertices, k_clamped_vertices);
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Classic::name,
                .summary = "position Verlet with iterated length constraints and a pull towards the rest pose",
                .source = "Nalu, GPU Gems 2, chapter 23, dynamics; Jakobsen 2003",
                .parameters = registry::table_of<Classic>(),
                .demands = k_solver_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches},
      .create = create,
      .substeps = substeps_of<Classic>,
      .follows_skin = true};
  return effect;
}

}  // namespace cuticle::sim::classic
