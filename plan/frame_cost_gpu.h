#pragma once
// What several submissions of a frame cost together.
#include "gpu/device.h"

namespace cuticle::plan {

/// Adds a submission's passes to the cost, those of one entry together.
void add_cost(const gpu::SubmitCost& more, gpu::SubmitCost& cost);

}  // namespace cuticle::plan
