#pragma once
// What each pixel sees, for who writes it to files and for passes over the picture.
#include "render/pass_gpu.h"
#include "render/passes/aovs/aovs.h"

namespace cuticle::render::aovs {

struct Layers {
  const gpu::Buffer* values = nullptr;      ///< floats per pixel: k_channels
  const gpu::Buffer* velocities = nullptr;  ///< of what a pixel sees, m/s: three floats; null where nothing asks
};

}  // namespace cuticle::render::aovs
