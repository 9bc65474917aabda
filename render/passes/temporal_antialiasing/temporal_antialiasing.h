#pragma once
#include "render/pass.h"

namespace cuticle::render::temporal_antialiasing {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::temporal_antialiasing
