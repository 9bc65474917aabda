#include <cuticle/sim/classic/classic.h>

namespace cuticle::sim::classic {
namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    {.name = "inner_step", .type = ParameterType::real, .unit = "s", .minimum = 1e-5, .maximum = 1,
     .default_text = "0.004166666666666667", .summary = "longest substep; a frame is cut into equal parts of at most this"},
    {.name = "max_substeps", .type = ParameterType::integer, .minimum = 1, .maximum = 4096, .default_text = "64",
     .summary = "most substeps in a frame; past that the substep stretches"},
    {.name = "iterations", .type = ParameterType::integer, .minimum = 1, .maximum = 1000, .default_text = "4",
     .summary = "sweeps over the length constraints per substep, root to tip"},
    {.name = "damping", .type = ParameterType::real, .unit = "1/s", .minimum = 0, .maximum = 1000, .default_text = "2",
     .summary = "velocity decays as exp(-damping t), in still air"},
    {.name = "shape_stiffness", .type = ParameterType::real, .unit = "1/s", .minimum = 0, .maximum = 1000,
     .default_text = "12", .summary = "rate of the pull towards the rest pose carried by the head, at the root"},
    {.name = "shape_tip", .type = ParameterType::real, .unit = "1", .minimum = 0, .maximum = 1, .default_text = "0.5",
     .summary = "share of the shape stiffness left at the tip"},
    {.name = "sag_free", .type = ParameterType::boolean, .default_text = "true",
     .summary = "the groom is combed under gravity: the pull, if there is one, carries the weight of the rest pose"},
    {.name = "clamped_vertices", .type = ParameterType::integer, .minimum = 1, .maximum = 2, .default_text = "2",
     .summary = "first vertices of a strand that the head carries: 2 keeps the direction in which hair leaves the scalp"},
};
constexpr std::string_view k_demands[] = {"simulation"};
constexpr std::string_view k_systems[] = {"N6", "N7", "N8"};

/// Integration and length constraints, once per substep.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) { return 2 * shape.substeps; }

}  // namespace

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect, .name = "classic",
                .summary = "position Verlet with iterated length constraints and a pull towards the rest pose",
                .source = "Nalu, GPU Gems 2, chapter 23, dynamics; Jakobsen 2003", .parameters = k_parameters,
                .demands = k_demands, .stage = registry::Stage::simulate, .systems = k_systems, .dispatches = dispatches},
      .create = create,
      .substeps = substeps};
  return effect;
}

}  // namespace cuticle::sim::classic
