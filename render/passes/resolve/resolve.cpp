#include <cuticle/render/passes/resolve/resolve.h>

namespace cuticle::render::resolve {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"output_color"};
constexpr Parameter k_parameters[] = {
    {.name = "background",
     .type = ParameterType::rgb,
     .minimum = 0,
     .maximum = 1000,
     .default_text = "0/0/0",
     .summary = "radiance behind everything, opaque; 0/0/0: none, the colour stays premultiplied by coverage"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "resolve",
                          .summary = "supersampled colour to the picture, by a box filter, over the background",
                          .source = "box filter over the pixel",
                          .parameters = k_parameters,
                          .demands = k_demands,
                          .stage = registry::Stage::resolve,
                          .draws = 1}};
  return pass;
}

}  // namespace cuticle::render::resolve
