#include "sim/classic/classic.h"
#include "sim/effect_parameters.h"

namespace cuticle::sim::classic {
namespace {

constexpr std::string_view k_orders[] = {"sequence", "red_black"};
constexpr registry::Parameter k_parameters[] = {
    inner_step(1, "0.004166666666666667"),
    k_max_substeps,
    whole_parameter("iterations", 1, 1000, "4", "sweeps over the length constraints per substep, root to tip"),
    {.name = "order",
     .type = registry::ParameterType::choice,
     .default_text = "sequence",
     .choices = k_orders,
     .summary = "of a sweep: segments one after the other, or every other one at once, then the rest"},
    flag_parameter("long_range", "true", "no vertex farther from the last carried one than the arc between them"),
    real_parameter("sphere_root", "m", 0, 100, "0",
                   "no vertex farther from its rest place carried by the head than this at the root ..."),
    real_parameter("sphere_tip", "m", 0, 100, "0", "... and this at the tip, linear between; both 0: no such spheres"),
    k_damping,
    k_shape_stiffness,
    k_shape_tip,
    k_sag_free,
    k_clamped_vertices,
};
constexpr std::string_view k_systems[] = {"N6", "N7", "N8", "H3", "H4", "H5", "H6"};

/// Integration and length constraints, once per substep.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return 2 * shape.substeps;
}

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "classic",
                .summary = "position Verlet with iterated length constraints and a pull towards the rest pose",
                .source = "Nalu, GPU Gems 2, chapter 23, dynamics; Jakobsen 2003",
                .parameters = k_parameters,
                .demands = k_solver_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches},
      .create = create,
      .substeps = substeps,
      .follows_skin = true};
  return effect;
}

}  // namespace cuticle::sim::classic
