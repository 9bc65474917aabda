#include "render/generating.h"

#include "render/frame.h"

namespace cuticle::render::interpolate_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "strands_interpolated"};
constexpr Use k_uses[] = {reads<StrandMaker>(), reads<SmoothedHairs>(), writes<DrawnHair>()};
constexpr std::string_view k_after[] = {"smooth_strands"};
constexpr std::string_view k_systems[] = {"N5"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      with_uses(writing_drawn({.name = "interpolate_strands",
                               .summary = "drawn strands between three smoothed control hairs each",
                               .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23.2",
                               .demands = k_demands,
                               .systems = k_systems,
                               .after = k_after}),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::interpolate_strands
