#include "render/passes/pixel_depth/pixel_depth.h"

#include "render/shading.h"

namespace cuticle::render::pixel_depth {

namespace {

constexpr std::string_view k_demands[] = {"output_color", "drawn_on_device", "pixel_depth"};

}  // namespace

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "pixel_depth",
                                   .summary = "how far away the nearest thing is that each pixel sees, scene or hair",
                                   .source = "the depth target, and the layer of hair that 'aovs' makes",
                                   .demands = k_demands,
                                   .stage = registry::Stage::resolve,
                                   .dispatches = always<1>},
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::pixel_depth
