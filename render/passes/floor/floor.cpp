#include "render/passes/floor/floor.h"

#include "render/shading.h"

namespace cuticle::render::floor {

namespace {

constexpr std::string_view k_demands[] = {"floor", "output_color"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.ambient, "ambient", "1", 0, 1, "share of the lights' sum that arrives from everywhere");
}

const Pass& entry() {
  static const Pass pass = shading({.name = "floor",
                                    .summary = "the scene's floor, on which hair and head cast shadows",
                                    .source = "Lambert",
                                    .parameters = registry::table_of<Parameters>(),
                                    .demands = k_demands,
                                    .draws = 1});
  return pass;
}

}  // namespace cuticle::render::floor
