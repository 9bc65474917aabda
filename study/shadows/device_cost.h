#pragma once
// What the settings of a comparison cost on a device.
#include <memory>

#include "gpu/device.h"
#include "study/shadows/comparison.h"

namespace cuticle::study {

/// Fills ComparisonRow::on_device of the rows whose method has passes on the device: the least of five submissions
/// after one that is not counted. Rows that the device refuses stay without; `progress` is told why. Error: where the
/// groom does not fit, or a submission fails.
Result<void> measure_on_device(std::shared_ptr<gpu::Device> device, const shadows::Casters& casters, Progress& progress,
                               Comparison& comparison);

}  // namespace cuticle::study
