#pragma once
// How pixels move.
#include "render/pass_gpu.h"
#include "render/passes/velocity/velocity.h"

namespace cuticle::render::velocity {

struct MotionVectors {
  const gpu::Buffer* values = nullptr;  ///< vec2 per pixel: pixels since the frame before
};

}  // namespace cuticle::render::velocity
