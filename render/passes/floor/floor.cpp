#include "render/passes/floor/floor.h"

#include "render/shading.h"

namespace cuticle::render::floor {

namespace {

constexpr std::string_view k_demands[] = {"floor", "output_color"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "ambient",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.05",
     .summary = "share of the lights' sum that arrives from everywhere"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass = shading({.name = "floor",
                                    .summary = "the scene's floor, on which hair and head cast shadows",
                                    .source = "Lambert",
                                    .parameters = k_parameters,
                                    .demands = k_demands,
                                    .draws = 1});
  return pass;
}

}  // namespace cuticle::render::floor
