#pragma once
// A frame of the method 'reference': what the device moved, drawn by paths on the CPU.
#include "core/image/image.h"
#include "core/progress.h"
#include "plan/strand_motion_gpu.h"
#include "plan/strand_set.h"

namespace cuticle::plan {

struct TracedFrame {
  Image color, layers;  ///< the colour over the scene's background; layers as render/reference has them
  std::string note;     ///< samples, error and time, in words
};

/// `hair`: the frame's drawn strands. `state`: file of the sums; empty: none. Head, floor and fins are diffuse, by the
/// albedos of their passes. Errors: usage, where the build has no Embree; those of render::reference::trace_picture.
Result<TracedFrame> trace_frame(gpu::Device& device, const scene::Scene& scene, const StrandSet& set,
                                const StrandMotion& motion, strands::Groom hair, const Camera& camera,
                                const std::string& state, Progress& progress);

}  // namespace cuticle::plan
