#include "render/passes/fins/fins.h"

#include "render/shading.h"

namespace cuticle::render::fins {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"fins_drawn", "output_color"};
constexpr std::string_view k_systems[] = {"N10"};
constexpr std::string_view k_after[] = {"head", "floor"};
constexpr Parameter albedo(std::string_view name, std::string_view default_text, std::string_view summary) {
  return {.name = name,
          .type = ParameterType::rgb,
          .minimum = 0,
          .maximum = 1,
          .default_text = default_text,
          .summary = summary};
}
constexpr Parameter share(std::string_view name, std::string_view default_text, std::string_view summary) {
  return {.name = name, .minimum = 0, .maximum = 1, .default_text = default_text, .summary = summary};
}
constexpr Parameter k_parameters[] = {
    albedo("root", "0.1/0.3/0.3", "diffuse albedo where the painted weight is 0"),
    albedo("tip", "0.5/0.75/0.6", "diffuse albedo where it is 1"),
    share("through", "0.4", "share of the light on the other side that comes through"),
    share("wrap", "0.3", "light carried past the terminator"),
    share("ambient", "0.12", "share of the lights' sum that arrives from everywhere"),
};

}  // namespace

const Pass& entry() {
  static const Pass pass = shading({.name = "fins",
                                    .summary = "the scene's fins, thin sheets, drawn before the strands",
                                    .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23",
                                    .parameters = k_parameters,
                                    .demands = k_demands,
                                    .systems = k_systems,
                                    .draws = 1,
                                    .after = k_after});
  return pass;
}

}  // namespace cuticle::render::fins
