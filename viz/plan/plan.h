#pragma once
// A view of what a picture cost: layers of an EXR that `render --aovs` wrote, as colours over the picture. Needs no
// VTK.
#include <string>

#include "core/image/image.h"
#include "viz/color/ramp.h"

namespace cuticle::viz {

struct PlanView {
  std::string file;  ///< FRAME.exr
  int tile = 16;     ///< pixels: side of the tiles whose means are drawn
};

/// Numbers of pixels or tiles, row 0 at the bottom.
struct CostMap {
  int width = 0, height = 0;
  std::vector<float> values;
};
struct PlanMaps {
  Image picture;          ///< R, G, B as the file has them, row 0 on top; empty: it has none
  CostMap cost, samples;  ///< of pixels: segments looked at (or strands shaded), and of those in the colour
  CostMap tile_cost;      ///< the mean over a tile
  CostMap strand_cost;    ///< of pixels: the mean cost of the pixels where the same strand is seen
  /// Shares of the pixels: hair that was shaded; looked at and found empty (culled); nothing looked at (skipped).
  double shaded = 0, culled = 0, skipped = 0;
};
/// Error: bad_input naming the file and the layer that it lacks.
Result<PlanMaps> read_plan(const PlanView& view);
/// costs.vti and tiles.vti. Error: bad_input.
Result<void> write_plan(const PlanView& view, const std::string& folder);

}  // namespace cuticle::viz
