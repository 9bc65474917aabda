#include "render/passes/aovs/aovs.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/shading.h"

namespace cuticle::render::aovs {

namespace {

constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<DrawnHair>(),
                          reads<StrandDraw>(),
                          reads<Targets>(),
                          reads<SeenHair>(),
                          may_read<HairTransmittance>(),
                          may_read<DrawnVelocities>().only_for<SeenVelocities>(),
                          writes<Layers>(),
                          writes<SeenVelocities>()};
constexpr std::string_view k_after[] = {"lines", "quads", "tiles"};

}  // namespace

const Pass& entry() {
  static const Pass pass = with_uses(
      of_whole_pictures(shading({.name = "aovs",
                                 .summary = "per pixel what is seen of the hair: depth, tangent, strand, coverage, "
                                            "transmittance, samples, cost",
                                 .source = "a visibility buffer read back",
                                 .dispatches = always<1>,
                                 .after = k_after})),
      k_uses);
  return pass;
}

}  // namespace cuticle::render::aovs
