#include "render/passes/velocity/velocity.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/aovs/aovs.h"
#include "render/passes/pixel_depth/pixel_depth.h"
#include "render/shading.h"

namespace cuticle::render::velocity {

namespace {

constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<DrawnHair>(),
                          reads<ControlHairs>(),
                          reads<aovs::Layers>(),
                          takes<pixel_depth::PixelDepth>(),
                          writes<MotionVectors>()};
constexpr std::string_view k_after[] = {"pixel_depth"};
constexpr std::string_view k_systems[] = {"F8"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.nodes, "nodes", 2, 128, "of the grid over the hair, along each axis");
}

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "velocity",
                                   .summary = "motion vectors of the hair: pixels to the world by their depth, moved "
                                              "back by a coarse grid of the control hairs' displacements",
                                   .source = "Frostbite, Every Strand Counts (2023): hair velocity",
                                   .parameters = registry::table_of<Parameters>(),
                                   .stage = registry::Stage::resolve,
                                   .systems = k_systems,
                                   .dispatches = always<8>,  // largest, splat, mean, four fills, pixels
                                   .after = k_after},
                         .uses = k_uses,
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::velocity
