#include "sim/cloth/cloth.h"
#include "sim/effect_parameters.h"

namespace cuticle::sim::cloth {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "fins"};
constexpr std::string_view k_systems[] = {"N10"};

}  // namespace

void describe(registry::Members& members, Cloth& cloth) {
  members(cloth.inner_step, inner_step_row(1));
  members(cloth.max_substeps, k_max_substeps);
  members(cloth.iterations, "iterations", 1, 1000, "sweeps over the edges per substep, root to tip");
  members(cloth.damping, k_damping);
  members(cloth.shape_stiffness, "shape_stiffness", "1/s", 0, 1000,
          "rate of the critically damped pull towards the skinned mesh, where the weight is 0");
  members(cloth.shape_tip, "shape_tip", "1", 0, 1, "share of it left where the weight is 1");
  members(cloth.sag_free, k_sag_free);
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = Cloth::name,
                .summary = "fins: a mesh by the particles of classic, blended with its skin by painted weights (CPU)",
                .source = "Nalu, GPU Gems 2, chapter 23, dynamics",
                .parameters = registry::table_of<Cloth>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems},
      .acts_on_fins = true};
  return effect;
}

}  // namespace cuticle::sim::cloth
