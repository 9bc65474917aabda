#pragma once
// Numbers per vertex that a view of strands is coloured by. Private to viz.
#include "viz/viz.h"

namespace cuticle::viz {

/// Length along the strand from its root, metres, one per vertex.
std::vector<float> arc_lengths(const strands::Groom& groom);

/// A simulated state as VTK XML polylines, metres; `scalar` is its point array "stretch" where there is one.
/// Error: bad_input naming the file.
Result<StrandsView> read_state(const std::string& path);

}  // namespace cuticle::viz
