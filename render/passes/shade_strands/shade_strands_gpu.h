#pragma once
// What points of strands send to the eye.
#include "render/pass_gpu.h"
#include "render/passes/shade_strands/shade_strands.h"

namespace cuticle::render::shade_strands {

struct StrandColors {
  const gpu::Buffer* values = nullptr;           ///< per vertex four halves: radiance, 1 where the strand is kept
  const gpu::Buffer* shaded_vertices = nullptr;  ///< as seen_vertices::SeenVertices::list; by points
};

}  // namespace cuticle::render::shade_strands
