#include "sim/effect_parameters.h"
#include "sim/solver.h"

namespace cuticle::sim::colliders {
namespace {

constexpr registry::Parameter k_parameters[] = {
    real_parameter("pearl_radius", "m", 0, 1, "0.001", "radius of the sphere on every particle"),
    flag_parameter(
        "fit_pearls", "true",
        "grow each pearl until its straight segments clear the collider (classic; exact clears segments without)"),
    real_parameter("friction", "1", 0, 10, "0",
                   "Coulomb's coefficient between hair and collider (exact; classic slides freely)"),
};
constexpr std::string_view k_demands[] = {"simulation", "colliders"};
constexpr std::string_view k_systems[] = {"N9", "G8"};
constexpr std::string_view k_after[] = {"classic", "exact"};

/// Contact and lengths in turn, once per substep (none of its own with a solver that fuses its effects).
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) { return shape.substeps; }

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = "colliders",
                .summary = "spheres, capsules, boxes and meshes push strands out (classic: spheres, with pearls on "
                           "particles)",
                .source = "Nalu, GPU Gems 2, chapter 23, collision",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches,
                .after = k_after}};
  return effect;
}

}  // namespace cuticle::sim::colliders
