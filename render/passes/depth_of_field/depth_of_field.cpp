#include "render/passes/depth_of_field/depth_of_field.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/pixel_depth/pixel_depth.h"
#include "render/shading.h"

namespace cuticle::render::depth_of_field {

namespace {

constexpr std::string_view k_demands[] = {"drawn_on_device", "depth_of_field"};
constexpr Use k_uses[] = {reads<FrameView>(), reads<pixel_depth::PixelDepth>(), changes<Output>()};
constexpr std::string_view k_after[] = {"ambient_occlusion", "temporal_antialiasing"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.lens_radius, "lens_radius", "mm", 0, 1000,
          "of the lens's opening; the focal length over twice this is the f-number");
  members(p.focus, "focus", "m", 0, 1e4, "distance along the view that is sharp; 0: of what the camera looks at");
  members(p.largest, registry::row("largest", "px", 1, 128, "radius that no disc of blur passes"));
  members(p.samples, "samples", 1, 1024,
          "pixels that are looked at for what lies before a pixel, and as many for the rest");
}

const Pass& entry() {
  static const Pass pass{
      .entry = {.kind = registry::EntryKind::pass,
                .name = "depth_of_field",
                .summary = "the picture as a lens of finite width sees it, from its colour and depth",
                .source = "thin lens; gathered as scattered discs, what lies in front apart",
                .parameters = registry::table_of<Parameters>(),
                .demands = k_demands,
                .stage = registry::Stage::output,
                .dispatches = always<3>,  // reach, spread, pixels
                .after = k_after},
      .uses = k_uses,
      .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::depth_of_field
