#include "render/passes/strands_in_sight/strands_in_sight.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/shading.h"

namespace cuticle::render::strands_in_sight {

namespace {

constexpr std::string_view k_demands[] = {"strands", "strands_by_sight"};
constexpr Use k_uses[] = {reads<FrameView>(), reads<DrawnHair>(), reads<StrandDraw>(), writes<StrandsInSight>()};
constexpr std::string_view k_systems[] = {"F4", "G8"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.wanted, "wanted", "false: strands out of view are shaded and sorted too, for the same picture");
}

const Pass& entry() {
  static const Pass pass = [] {
    Pass made = with_uses(shading({.name = "strands_in_sight",
                                   .summary = "a list of the strands in view: shadows are looked up, and tiles sorted, "
                                              "for these alone",
                                   .source = "Assarsson and Moeller 2000: culling by the sides of the view",
                                   .parameters = registry::table_of<Parameters>(),
                                   .demands = k_demands,
                                   .systems = k_systems,
                                   .dispatches = always<2>}),  // which are in sight, list
                          k_uses);
    made.entry.stage = registry::Stage::shadow;
    return made;
  }();
  return pass;
}

}  // namespace cuticle::render::strands_in_sight
