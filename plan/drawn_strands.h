#pragma once
// The strands that a frame draws, on the CPU.
#include "plan/strand_set.h"

namespace cuticle::plan {

/// What the passes that generate strands make on a device, within 1e-5 m (traced_scene_runner_gpu_test). `control`:
/// world places of the control vertices; `turn`: of the head, from the rest pose.
strands::Groom drawn_strands_at(const scene::Scene& scene, const StrandSet& set, std::span<const glm::vec3> control,
                                const glm::dmat3& turn);

}  // namespace cuticle::plan
