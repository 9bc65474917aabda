#include "render/passes/motion_blur/motion_blur.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/pixel_depth/pixel_depth.h"
#include "render/passes/velocity/velocity.h"
#include "render/shading.h"

namespace cuticle::render::motion_blur {

namespace {

constexpr std::string_view k_demands[] = {"drawn_on_device", "motion_blur", "movement"};
constexpr Use k_uses[] = {reads<FrameView>(), reads<pixel_depth::PixelDepth>(), reads<velocity::MotionVectors>(),
                          changes<Output>()};
constexpr std::string_view k_after[] = {"ambient_occlusion", "temporal_antialiasing", "depth_of_field"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.shutter, "shutter", "frames", 0, 4, "how long it is open, half before and half after the frame's time");
  members(p.largest, registry::row("largest", "px", 1, 256, "way to either side that no blur passes"));
  members(p.samples, "samples", 1, 256, "moments that each pixel is looked at in");
}

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "motion_blur",
                                   .summary = "the mean over an open shutter, from the picture, its depth "
                                              "and how its pixels move",
                                   .source = "moments gathered along the largest motion near a pixel "
                                             "(tiles of McGuire, Hennessy, "
                                             "Bukowski and Osman 2012)",
                                   .parameters = registry::table_of<Parameters>(),
                                   .demands = k_demands,
                                   .stage = registry::Stage::output,
                                   .dispatches = always<3>,  // reach, spread, pixels
                                   .after = k_after},
                         .uses = k_uses,
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::motion_blur
