#include "render/passes/ambient_occlusion/ambient_occlusion.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/pixel_depth/pixel_depth.h"
#include "render/shading.h"

namespace cuticle::render::ambient_occlusion {

namespace {

constexpr std::string_view k_demands[] = {"drawn_on_device", "ambient_occlusion"};
constexpr Use k_uses[] = {reads<FrameView>(), reads<pixel_depth::PixelDepth>(), changes<Output>()};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.radius, "radius", "mm", 0.01, 1e4, "of the sphere around a point in which what is open counts");
  members(p.strength, "strength", "1", 0, 1, "share of the light that is taken away where nothing is open");
  members(p.largest,
          registry::row("largest", "px", 1, 1024, "the sphere shrinks near the camera to this radius on the screen"));
  members(p.samples, "samples", 1, 512, "pairs of lines through the sphere");
}

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "ambient_occlusion",
                                   .summary = "darkens what lies in hollows of the depth that the picture sees",
                                   .source = "volumetric obscurance by line samples (Loos and Sloan 2010)",
                                   .parameters = registry::table_of<Parameters>(),
                                   .demands = k_demands,
                                   .stage = registry::Stage::output,
                                   .dispatches = always<1>},
                         .uses = k_uses,
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::ambient_occlusion
