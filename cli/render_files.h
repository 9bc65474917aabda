#pragma once
// The files of a rendered frame.
#include <string>
#include <vector>

#include "core/result.h"
#include "plan/frame_runner_gpu.h"
#include "scene/scene.h"

namespace cuticle::cli {

/// Writes FOLDER/frame_NNNN.exr (linear, with layers and mattes where the scene asks for them), .png (tone mapped) and,
/// for outputs.deep, .deep.exr; returns their names. Layers are written as floats: halves do not hold the numbers of
/// strands. Error: of the file system.
Result<std::vector<std::string>> write_frame(const std::string& folder, int frame, plan::FrameResult& result,
                                             const scene::Scene& scene);

}  // namespace cuticle::cli
