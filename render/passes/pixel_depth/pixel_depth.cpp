#include "render/passes/pixel_depth/pixel_depth.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/aovs/aovs.h"
#include "render/shading.h"

namespace cuticle::render::pixel_depth {

namespace {

constexpr std::string_view k_demands[] = {"drawn_on_device"};
constexpr Use k_uses[] = {reads<FrameView>(),       reads<Targets>(),
                          reads<TargetDepth>(),     may_read<DrawnSurfaces>(),
                          may_read<StrandPixels>(), may_read<aovs::Layers>().only_where("drawn_by_tiles"),
                          takes<aovs::Layers>(),    writes<PixelDepth>()};

}  // namespace

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "pixel_depth",
                                   .summary = "how far away the nearest thing is that each pixel sees, scene or hair",
                                   .source = "the depth target, and the layer of hair that 'aovs' makes",
                                   .demands = k_demands,
                                   .stage = registry::Stage::resolve,
                                   .dispatches = always<1>},
                         .uses = k_uses,
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::pixel_depth
