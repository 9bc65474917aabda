#include <cuticle/sim/detail/chain_parameters.h>
#include <cuticle/sim/rod/rod.h>

namespace cuticle::sim::rod {
namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    detail::k_inner_step,
    detail::k_max_substeps,
    detail::k_damping,
    {.name = "young_modulus",
     .type = ParameterType::real,
     .unit = "Pa",
     .minimum = 0,
     .maximum = 1e20,
     .default_text = "3.9e9",
     .summary = "E of the fibre; 0: it does not bend back"},
    {.name = "shear_modulus",
     .type = ParameterType::real,
     .unit = "Pa",
     .minimum = 0,
     .maximum = 1e20,
     .default_text = "0.9e9",
     .summary = "G of the fibre; 0: it does not twist back"},
    {.name = "fibre_radius",
     .type = ParameterType::real,
     .unit = "m",
     .minimum = 1e-6,
     .maximum = 0.01,
     .default_text = "3.5e-5",
     .summary = "of the fibre, or of as many as move as one: EI = E pi r^4 / 4, GJ = G pi r^4 / 2"},
    {.name = "density",
     .type = ParameterType::real,
     .unit = "kg/m^3",
     .minimum = 1,
     .maximum = 1e5,
     .default_text = "1300",
     .summary = "of the fibre"},
    {.name = "sag_free",
     .type = ParameterType::boolean,
     .default_text = "true",
     .summary = "the groom is combed under gravity: the natural shape is the one that gravity bends into the rest pose"},
    {.name = "clamped_vertices",
     .type = ParameterType::integer,
     .minimum = 1,
     .maximum = 2,
     .default_text = "1",
     .summary = "first vertices of a strand that the head carries; the rod is clamped at the last of them"},
    detail::k_double_precision,
};
constexpr std::string_view k_systems[] = {"N6", "N8"};

}  // namespace

const Effect& entry() {
  static const Effect effect = {.entry = {.kind = registry::EntryKind::effect,
                                          .name = "rod",
                                          .summary = "fibres that bend and twist with physical stiffness and cannot stretch: one Newton "
                                                     "step on bending and all lengths",
                                          .source = "Bergou et al. 2008 (frames, quasi-static twist); Mueller et al. "
                                                    "2012 (follow the leader)",
                                          .parameters = k_parameters,
                                          .demands = detail::k_demands,
                                          .stage = registry::Stage::simulate,
                                          .systems = k_systems,
                                          .dispatches = detail::one_dispatch},
                                .create = create,
                                .substeps = detail::substeps,
                                .fuses_effects = true};
  return effect;
}

}  // namespace cuticle::sim::rod
