#include "render/passes/cull_strands/cull_strands.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/shading.h"

namespace cuticle::render::cull_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "culled_strands"};
constexpr Use k_uses[] = {reads<FrameView>(),   reads<DrawnHair>(),        reads<StrandDraw>(),  reads<Targets>(),
                          reads<TargetDepth>(), may_read<DrawnSurfaces>(), writes<SeenStrands>()};
constexpr std::string_view k_after[] = {"head", "fins", "floor"};
constexpr std::string_view k_systems[] = {"F4"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.wanted, "wanted", "false: strands that are not seen are drawn too, for the same picture");
}

const Pass& entry() {
  static const Pass pass = with_uses(
      shading({.name = "cull_strands",
               .summary = "a list of the strands that are in view and not behind the scene, for 'lines' and 'quads'",
               .source = "Greene, Kass and Miller 1993: a depth per tile; the coarse rasteriser of 'tiles'",
               .parameters = registry::table_of<Parameters>(),
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = always<3>,  // depth of the scene, which are seen, list
               .after = k_after}),
      k_uses);
  return pass;
}

}  // namespace cuticle::render::cull_strands
