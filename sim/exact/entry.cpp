#include <cuticle/sim/detail/chain_parameters.h>
#include <cuticle/sim/exact/exact.h>

namespace cuticle::sim::exact {
namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    detail::k_inner_step,
    detail::k_max_substeps,
    detail::k_damping,
    {.name = "shape_stiffness",
     .type = ParameterType::real,
     .unit = "1/s",
     .minimum = 0,
     .maximum = 1000,
     .default_text = "12",
     .summary = "rate of the critically damped pull towards the rest pose, at the root"},
    {.name = "shape_tip",
     .type = ParameterType::real,
     .unit = "1",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.5",
     .summary = "share of the shape stiffness left at the tip"},
    {.name = "sag_free",
     .type = ParameterType::boolean,
     .default_text = "true",
     .summary = "the groom is combed under gravity: the pull, if there is one, carries the weight of the rest pose"},
    {.name = "clamped_vertices",
     .type = ParameterType::integer,
     .minimum = 1,
     .maximum = 2,
     .default_text = "2",
     .summary =
         "first vertices of a strand that the head carries: 2 keeps the direction in which hair leaves the scalp"},
    detail::k_double_precision,
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
                                          .demands = detail::k_demands,
                                          .stage = registry::Stage::simulate,
                                          .systems = k_systems,
                                          .dispatches = detail::one_dispatch},
                                .create = create,
                                .substeps = detail::substeps,
                                .fuses_effects = true};
  return effect;
}

}  // namespace cuticle::sim::exact
