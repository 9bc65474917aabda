#include "render/generating.h"

namespace cuticle::render::interpolate_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "strands_interpolated"};
constexpr std::string_view k_after[] = {"smooth_strands"};
constexpr std::string_view k_systems[] = {"N5"};

}  // namespace

const Pass& entry() {
  static const Pass pass = generating({.name = "interpolate_strands",
                                       .summary = "drawn strands between three smoothed control hairs each",
                                       .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23.2",
                                       .demands = k_demands,
                                       .systems = k_systems,
                                       .after = k_after});
  return pass;
}

}  // namespace cuticle::render::interpolate_strands
