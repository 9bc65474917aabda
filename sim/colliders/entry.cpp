#include <cuticle/sim/solver.h>

namespace cuticle::sim::colliders {
namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    {.name = "pearl_radius", .type = ParameterType::real, .unit = "m", .minimum = 0, .maximum = 1, .default_text = "0.001",
     .summary = "radius of the sphere on every particle"},
    {.name = "fit_pearls", .type = ParameterType::boolean, .default_text = "true",
     .summary = "grow each pearl until its straight segments clear the collider (classic; exact clears segments without)"},
    {.name = "friction", .type = ParameterType::real, .unit = "1", .minimum = 0, .maximum = 10, .default_text = "0",
     .summary = "Coulomb's coefficient between hair and collider (exact; classic slides freely)"},
};
constexpr std::string_view k_demands[] = {"simulation", "colliders"};
constexpr std::string_view k_systems[] = {"G8"};
constexpr std::string_view k_after[] = {"classic", "exact"};

/// Contact and lengths in turn, once per substep (none of its own with a solver that fuses its effects).
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) { return shape.substeps; }

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect, .name = "colliders",
                .summary = "spheres push the particles out, each with a pearl so that long segments do not cut through",
                .source = "Nalu, GPU Gems 2, chapter 23, collision", .parameters = k_parameters, .demands = k_demands,
                .stage = registry::Stage::simulate, .systems = k_systems, .dispatches = dispatches, .after = k_after}};
  return effect;
}

}  // namespace cuticle::sim::colliders
