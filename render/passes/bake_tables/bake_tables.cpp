#include "render/passes/bake_tables/bake_tables.h"

namespace cuticle::render::bake_tables {

namespace {

constexpr std::string_view k_demands[] = {"light", "strands", "output_color", "shaded_from_tables"};
constexpr std::string_view k_systems[] = {"N12"};

constexpr registry::Parameter k_parameters[] = {
    {.name = "mip_levels",
     .type = registry::ParameterType::boolean,
     .default_text = "false",
     .summary = "lookups that lie more than a texel apart from pixel to pixel read a mean of texels; by `lines`"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "bake_tables",
                          .summary = "lookup tables of the scattering model, once, before the first frame",
                          .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23",
                          .parameters = k_parameters,
                          .demands = k_demands,
                          .stage = registry::Stage::prepare,
                          .systems = k_systems}};
  return pass;
}

}  // namespace cuticle::render::bake_tables
