#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::cloth {
namespace {

constexpr registry::Parameter k_parameters[] = {
    inner_step(1, "0.004166666666666667"),
    k_max_substeps,
    whole_parameter("iterations", 1, 1000, "8", "sweeps over the edges per substep, root to tip"),
    k_damping,
    real_parameter("shape_stiffness", "1/s", 0, 1000, "12",
                   "rate of the critically damped pull towards the skinned mesh, where the weight is 0"),
    real_parameter("shape_tip", "1", 0, 1, "0.2", "share of it left where the weight is 1"),
    k_sag_free,
};
constexpr std::string_view k_demands[] = {"simulation", "fins"};
constexpr std::string_view k_systems[] = {"N10"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "cloth",
                .summary = "fins: a mesh by the particles of classic, blended with its skin by painted weights (CPU)",
                .source = "Nalu, GPU Gems 2, chapter 23, dynamics",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems},
      .acts_on_fins = true};
  return effect;
}

}  // namespace cuticle::sim::cloth
