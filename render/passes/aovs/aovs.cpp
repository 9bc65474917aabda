#include "render/passes/aovs/aovs.h"

#include "render/shading.h"

namespace cuticle::render::aovs {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "output_aovs", "seen_segments"};
constexpr std::string_view k_after[] = {"lines", "quads", "tiles"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      of_whole_pictures(shading({.name = "aovs",
                                 .summary = "per pixel what is seen of the hair: depth, tangent, strand, coverage, "
                                            "transmittance, samples, cost",
                                 .source = "a visibility buffer read back",
                                 .demands = k_demands,
                                 .dispatches = always<1>,
                                 .after = k_after}));
  return pass;
}

}  // namespace cuticle::render::aovs
