#pragma once
// Where inside a pixel the camera of a frame looks.
#include "render/pass_gpu.h"

namespace cuticle::render::temporal_antialiasing {

/// Camera::pixel_shift of the frame, -.51 .. .51 pixels: one after another of the pass's `frames` points of Halton's
/// sequence in bases 2 and 3 (1960), about their own middle, so that their mean is no shift, beginning anew after a cut.
glm::dvec2 pixel_shift(const FrameResources& resources);

}  // namespace cuticle::render::temporal_antialiasing
