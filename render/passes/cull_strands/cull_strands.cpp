#include "render/passes/cull_strands/cull_strands.h"

#include "render/shading.h"

namespace cuticle::render::cull_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "culled_strands"};
constexpr std::string_view k_after[] = {"head", "fins", "floor"};
constexpr std::string_view k_systems[] = {"F4"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "wanted",
     .type = registry::ParameterType::boolean,
     .default_text = "true",
     .summary = "false: strands that are not seen are drawn too, for the same picture"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      shading({.name = "cull_strands",
               .summary = "a list of the strands that are in view and not behind the scene, for 'lines' and 'quads'",
               .source = "Greene, Kass and Miller 1993: a depth per tile; the coarse rasteriser of 'tiles'",
               .parameters = k_parameters,
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = always<3>,  // depth of the scene, which are seen, list
               .after = k_after});
  return pass;
}

}  // namespace cuticle::render::cull_strands
