#include "render/passes/resolve/resolve.h"

#include "render/frame.h"

namespace cuticle::render::resolve {

namespace {

constexpr std::string_view k_demands[] = {"drawn_on_device"};
constexpr Use k_uses[] = {reads<Targets>(), may_read<DrawnSurfaces>(), may_read<StrandPixels>(), writes<Output>()};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.background, "background", "1", 0, 1000,
          "radiance behind everything, opaque; 0/0/0: none, the colour stays premultiplied by coverage");
}

const Pass& entry() {
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "resolve",
                          .summary = "supersampled colour to the picture, by a box filter, over the background",
                          .source = "box filter over the pixel",
                          .parameters = registry::table_of<Parameters>(),
                          .demands = k_demands,
                          .stage = registry::Stage::resolve,
                          .draws = 1},
                         k_uses};
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
