#include "render/passes/reference/reference_entry.h"

#include <vector>

#include "shadows/method.h"

namespace cuticle::render::reference {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_reference_demands[] = {"strands", "output_color", "drawn_by_reference"};
constexpr std::string_view k_fields[] = {"near", "far"};

/// "traced", then every shadow method.
std::span<const std::string_view> shadow_choices() {
  static const std::vector<std::string_view> choices = [] {
    std::vector<std::string_view> names = {"traced"};
    for (const shadows::Method* method : shadows::methods()) names.push_back(method->entry.name);
    return names;
  }();
  return choices;
}

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
    {.name = "lamp_radius",
     .unit = "m",
     .minimum = 0,
     .maximum = 10,
     .default_text = "0",
     .summary = "of every lamp, a sphere of even radiance; 0: points"},
    {.name = "sun_angle",
     .unit = "rad",
     .minimum = 0,
     .maximum = 1.5,
     .default_text = "0",
     .summary = "half the angle under which distant lights are seen; 0: points"},
    {.name = "tables",
     .type = ParameterType::boolean,
     .default_text = "false",
     .summary = "lookup tables of the material's layout and size, of the far field, in the place of the model"},
};

/// With every registered shadow method as a choice of `shadow`.
std::span<const Parameter> parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> rows(std::begin(k_reference_parameters), std::end(k_reference_parameters));
    rows.push_back(
        {.name = "shadow",
         .type = ParameterType::choice,
         .default_text = "traced",
         .choices = shadow_choices(),
         .summary =
             "what of a light arrives at hair: by rays, or by a shadow method at the vertices; with the parameters "
             "of shadow.method where it is the scene's, and with fibre_alpha"});
    return rows;
  }();
  return table;
}

}  // namespace

const Pass& entry() {
  static const Pass pass{
      .entry = {.kind = registry::EntryKind::pass,
                .name = "reference",
                .summary = "path tracing on the CPU: light that scatters from fibre to fibre, without tables or maps",
                .source = "Kajiya 1986; Veach 1997 (multiple importance sampling); the material's own fibre model",
                .parameters = parameters(),
                .demands = k_reference_demands,
                .stage = registry::Stage::resolve},
      .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::reference
