#pragma once
// Times every pass on a device, on small scenes of two sizes of hair and two of the picture.
#include <memory>
#include <span>

#include "core/progress.h"
#include "gpu/device.h"
#include "plan/budgets.h"
#include "plan/cost_table.h"
#include "plan/frame_runner_gpu.h"

namespace cuticle::plan {

/// A frame whose passes have the device's times; where that is software, those of the processor, over all its cores:
/// other programs beside it do not count. Errors: of the device.
Result<FrameResult> timed_frame(FrameRunner& runner, const gpu::Device& device, int frame, bool everything);

/// At most about `seconds`: what was not reached is not in the table. Each time is the least of up to three frames;
/// frames of further scenes tell how far expectations are off. `settings`: of shadow methods, timed as well, as
/// cost_name names them. Error: of the device.
Result<CostTable> calibrate(std::shared_ptr<gpu::Device> device, std::span<const AccuracyRow> settings, double seconds,
                            Progress& progress);

}  // namespace cuticle::plan
