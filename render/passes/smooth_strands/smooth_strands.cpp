#include "render/generating.h"

#include "render/frame.h"

namespace cuticle::render::smooth_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "strands_interpolated"};
constexpr Use k_uses[] = {reads<ControlHairs>(), reads<StrandMaker>(), writes<SmoothedHairs>()};
constexpr std::string_view k_systems[] = {"N4"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      with_uses(generating({.name = "smooth_strands",
                            .summary = "control hairs to Bezier curves from this frame's tangents, resampled",
                            .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23.2",
                            .demands = k_demands,
                            .systems = k_systems}),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::smooth_strands
