#pragma once
// How far off the settings are that a scene's budgets choose from: the table scenes/accuracy.json.
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "gpu/device.h"
#include "plan/budgets.h"

namespace cuticle::study {

/// Shadow methods against ray-traced truth, ways to draw against brute force, table sizes against the model, and
/// substeps against 7,680 a second in double, on the first frames of these scenes. The errors do not depend on the
/// device. `parts`: of "shadow", "coverage", "shading", "motion" those that are measured. Error: what loading and
/// drawing say; usage where this build has no ray-traced truth.
Result<plan::AccuracyTable> measure_accuracy(const std::shared_ptr<gpu::Device>& device,
                                             const std::vector<std::string>& scenes,
                                             const std::vector<std::string>& parts, Progress& progress);

/// The errors of one scene as it stands: transmittance of its first light, coverage, scattering.
Result<std::vector<plan::AccuracyRow>> measure_scene(const std::shared_ptr<gpu::Device>& device,
                                                     const scene::Scene& scene, Progress& progress);

}  // namespace cuticle::study
