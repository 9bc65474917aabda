#include "render/passes/cards/cards.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/dual_scattering/dual_scattering.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/shading.h"

namespace cuticle::render::cards {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_cards"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<Lights>(),
                          reads<FibreMaterial>(),
                          reads<Surfaces>(),
                          reads<RestStrands>(),
                          reads<DrawnHair>(),
                          reads<Targets>(),
                          may_read<HairTransmittance>(),
                          may_read<surface_shadow::Maps>(),
                          may_read<dual_scattering::Terms>(),
                          may_read<DrawnSurfaces>(),
                          writes<StrandPixels>()};
constexpr std::string_view k_after[] = {"head", "fins", "floor", "dual_scattering"};
constexpr std::string_view k_systems[] = {"A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8", "A9", "A10"};
constexpr std::string_view k_schemes[] = {"four_pass", "three_pass"};
constexpr std::string_view k_orders[] = {"static", "groups", "cards"};
constexpr std::string_view k_depth_writes[] = {"printed", "off", "front", "both"};

/// Cards follow their strands; for an order at run time their depths are taken and sorted.
std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape&) {
  return registry::from_values<Parameters>(values).order == Order::inside_to_outside ? 1 : 3;
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.three_pass, "scheme", k_schemes,
          "four_pass: depth of the opaque parts first, then these where their depth is equal, back faces, front "
          "faces; three_pass: without the first");
  members(p.order, "order", k_orders,
          "static: inside to outside, as computed beforehand; groups: groups (swings_from) by their depth, in "
          "those that swing cards by theirs; cards: all by depth");
  members(p.transparent_depth, "transparent_depth", k_depth_writes,
          "which transparent faces write depth; printed: the front faces of three_pass, none of four_pass");
  members(p.opaque_alpha, "opaque_alpha", "1", 0.01, 1, "alpha from which on a texel is opaque");
  members(p.count_fragments, "count_fragments",
          "fragments of each draw are counted, by the shader and by the device's statistics, and told");
  describe(members, static_cast<strands::CardParameters&>(p));
}

const Pass& entry() {
  static const Pass pass = with_uses(
      of_whole_pictures(shading(
          {.name = "cards",
           .summary = "strands as textured cards with ambient occlusion, opaque and transparent parts in passes",
           .source = "Scheuermann 2004, Hair Rendering and Shading (GDC)",
           .parameters = registry::table_of<Parameters>(),
           .demands = k_demands,
           .systems = k_systems,
           .dispatches = dispatches,
           .draws = 4,
           .after = k_after})),
      k_uses);
  return pass;
}

}  // namespace cuticle::render::cards
