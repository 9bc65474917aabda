#include "render/passes/bake_tables/bake_tables.h"

#include "render/inputs.h"

namespace cuticle::render::bake_tables {

namespace {

constexpr std::string_view k_demands[] = {"light", "shaded_from_tables"};
constexpr Use k_uses[] = {reads<FibreMaterial>(), writes<Tables>()};
constexpr std::string_view k_systems[] = {"N12"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.mip_levels, "mip_levels",
          "lookups that lie more than a texel apart from pixel to pixel read a mean of texels; by `lines`");
}

const Pass& entry() {
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "bake_tables",
                          .summary = "lookup tables of the scattering model, once, before the first frame",
                          .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23",
                          .parameters = registry::table_of<Parameters>(),
                          .demands = k_demands,
                          .stage = registry::Stage::prepare,
                          .systems = k_systems},
                         k_uses};
  return pass;
}

}  // namespace cuticle::render::bake_tables
