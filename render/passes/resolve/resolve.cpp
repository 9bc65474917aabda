#include "render/passes/resolve/resolve.h"

namespace cuticle::render::resolve {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"output_color", "drawn_on_device"};
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

void add_background(Image& image, const glm::dvec3& background) {
  if (background == glm::dvec3(0)) return;
  for (std::size_t p = 0; p < image.pixels.size(); p += 4) {
    const float open = 1 - image.pixels[p + 3];
    for (int c = 0; c < 3; ++c) image.pixels[p + std::size_t(c)] += open * float(background[c]);
    image.pixels[p + 3] = 1;
  }
}

}  // namespace cuticle::render::resolve
