#include "render/generating.h"

namespace cuticle::render::smooth_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "strands_interpolated"};
constexpr std::string_view k_systems[] = {"N4"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      generating({.name = "smooth_strands",
                  .summary = "control hairs to Bezier curves from this frame's tangents, resampled",
                  .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23.2",
                  .demands = k_demands,
                  .systems = k_systems});
  return pass;
}

}  // namespace cuticle::render::smooth_strands
