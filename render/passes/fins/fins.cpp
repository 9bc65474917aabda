#include "render/passes/fins/fins.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/shading.h"

namespace cuticle::render::fins {

namespace {

constexpr std::string_view k_demands[] = {"fins_drawn"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<Lights>(),
                          reads<FibreOpacity>(),
                          reads<Surfaces>(),
                          reads<Targets>(),
                          reads<FinVertices>(),
                          may_read<surface_shadow::Maps>(),
                          changes<DrawnSurfaces>()};
constexpr std::string_view k_systems[] = {"N10"};
constexpr std::string_view k_after[] = {"head", "floor"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.root, "root", "1", 0, 1, "diffuse albedo where the painted weight is 0");
  members(p.tip, "tip", "1", 0, 1, "diffuse albedo where it is 1");
  members(p.through, "through", "1", 0, 1, "share of the light on the other side that comes through");
  members(p.wrap, "wrap", "1", 0, 1, "light carried past the terminator");
  members(p.ambient, "ambient", "1", 0, 1, "share of the lights' sum that arrives from everywhere");
}

const Pass& entry() {
  static const Pass pass = with_uses(shading({.name = "fins",
                                              .summary = "the scene's fins, thin sheets, drawn before the strands",
                                              .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23",
                                              .parameters = registry::table_of<Parameters>(),
                                              .demands = k_demands,
                                              .systems = k_systems,
                                              .draws = 1,
                                              .after = k_after}),
                                     k_uses);
  return pass;
}

}  // namespace cuticle::render::fins
