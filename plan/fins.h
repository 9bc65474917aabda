#pragma once
// A scene's fins before the first frame: their mesh and the weight painted on it.
#include "plan/strand_set.h"

namespace cuticle::plan {

/// Reads mesh and weight map into `set`. Corners at one place become one vertex (with the first one's texture
/// coordinates), so that seams do not tear. The weight of a vertex is the map's first channel at its texture
/// coordinates (u to the right, v up, between texels, clamped to the edge), as stored: no transfer curve. Error:
/// bad_input from the readers, or naming the mesh that has no texture coordinates.
Result<void> read_fins(const scene::FinSource& source, StrandSet& set);

}  // namespace cuticle::plan
