#pragma once
// The drawn strands that may be in the picture, as kernels over vertices or segments read them.
#include "render/pass_gpu.h"
#include "render/passes/strands_in_sight/strands_in_sight.h"

namespace cuticle::render::strands_in_sight {

struct StrandsInSight {
  gpu::Buffer list;  ///< of strands/lod/strand_list_gpu.h
};

}  // namespace cuticle::render::strands_in_sight
