#include "render/passes/floor/floor.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/shading.h"

namespace cuticle::render::floor {

namespace {

constexpr std::string_view k_demands[] = {"floor"};
constexpr Use k_uses[] = {reads<FrameView>(),      reads<Lights>(),  reads<FibreOpacity>(),
                          reads<Surfaces>(),       reads<Targets>(), may_read<surface_shadow::Maps>(),
                          changes<DrawnSurfaces>()};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.ambient, "ambient", "1", 0, 1, "share of the lights' sum that arrives from everywhere");
}

const Pass& entry() {
  static const Pass pass = with_uses(shading({.name = "floor",
                                              .summary = "the scene's floor, on which hair and head cast shadows",
                                              .source = "Lambert",
                                              .parameters = registry::table_of<Parameters>(),
                                              .demands = k_demands,
                                              .draws = 1}),
                                     k_uses);
  return pass;
}

}  // namespace cuticle::render::floor
