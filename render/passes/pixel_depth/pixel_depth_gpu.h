#pragma once
// How far away each pixel is.
#include "render/pass_gpu.h"
#include "render/passes/pixel_depth/pixel_depth.h"

namespace cuticle::render::pixel_depth {

struct PixelDepth {
  const gpu::Buffer* values = nullptr;  ///< float per pixel: 1 / distance of the nearest thing; 0: none
};

}  // namespace cuticle::render::pixel_depth
