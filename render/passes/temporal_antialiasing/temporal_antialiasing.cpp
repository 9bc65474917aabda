#include "render/passes/temporal_antialiasing/temporal_antialiasing.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/pixel_depth/pixel_depth.h"
#include "render/passes/velocity/velocity.h"
#include "render/shading.h"

namespace cuticle::render::temporal_antialiasing {

namespace {

constexpr std::string_view k_demands[] = {"drawn_by_quads", "temporal_antialiasing"};
constexpr Use k_uses[] = {reads<FrameView>(), reads<pixel_depth::PixelDepth>(), reads<velocity::MotionVectors>(),
                          changes<Output>()};
constexpr std::string_view k_after[] = {"ambient_occlusion"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.frames, "frames", 1, 256,
          "whose mean a still picture becomes; also the places inside a pixel that cameras take in turn");
  members(p.spread, "spread", "1", 0, 100,
          "standard deviations of the pixels around by which what is remembered may leave their mean");
}

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "temporal_antialiasing",
                                   .summary = "the mean of the frames before, shifted inside a pixel, "
                                              "moved to where things are now",
                                   .source = "Karis 2014, High Quality Temporal Supersampling; clamp: Salvi 2016",
                                   .parameters = registry::table_of<Parameters>(),
                                   .demands = k_demands,
                                   .stage = registry::Stage::output,
                                   .dispatches = always<1>,
                                   .after = k_after},
                         .uses = k_uses,
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::temporal_antialiasing
