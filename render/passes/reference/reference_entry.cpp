#include "render/passes/reference/reference_entry.h"

namespace cuticle::render::reference {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_reference_demands[] = {"strands", "output_color", "drawn_by_reference"};
constexpr std::string_view k_fields[] = {"near", "far"};
constexpr Parameter k_reference_parameters[] = {
    {.name = "samples",
     .type = ParameterType::integer,
     .minimum = 1,
     .maximum = 1e6,
     .default_text = "64",
     .summary = "paths of a pixel, at most"},
    {.name = "bounces",
     .type = ParameterType::integer,
     .minimum = 0,
     .maximum = 1e6,
     .default_text = "0",
     .summary = "scatterings of a path, at most; 1: direct light alone; 0: all"},
    {.name = "max_error",
     .minimum = 0,
     .maximum = 10,
     .default_text = "0",
     .summary = "relative standard error of a pixel from which on its tile of 16 x 16 rests; 0: none rests"},
    {.name = "seed",
     .type = ParameterType::integer,
     .minimum = 0,
     .maximum = 4294967295.0,
     .default_text = "0",
     .summary = "of the random numbers"},
    {.name = "field",
     .type = ParameterType::choice,
     .default_text = "near",
     .choices = k_fields,
     .summary = "of models that have both; near: at the offset of the hit; far: the mean over the fibre's width"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass{
      .entry = {.kind = registry::EntryKind::pass,
                .name = "reference",
                .summary = "path tracing on the CPU: light that scatters from fibre to fibre, without tables or maps",
                .source = "Kajiya 1986; Veach 1997 (multiple importance sampling); the material's own fibre model",
                .parameters = k_reference_parameters,
                .demands = k_reference_demands,
                .stage = registry::Stage::resolve},
      .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::reference
