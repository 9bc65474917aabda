#pragma once
// Level of detail: what of the strands is drawn.
#include "render/pass_gpu.h"

namespace cuticle::render::visibility {

/// F10: what of the strands a frame draws.
struct DrawnPart {
  std::uint32_t strands = 0, segments = 0;  ///< the first of them; of each
  double width = 1;                         ///< factor that makes up for the strands left out
  double opacity = 1;                       ///< of a strand where it is drawn wider again by 1 / opacity
};
/// All where the strands cover `full_px` pixels, or where it is 0. Widths go in steps of the fourth root
/// of 2, each with as many strands as cover the area of all.
/// With `whole_segments` those that a scene cut into parts count as one, where no level of detail leaves any out.
DrawnPart drawn_part(const Resources& resources, double full_px, bool whole_segments = false);

}  // namespace cuticle::render::visibility
