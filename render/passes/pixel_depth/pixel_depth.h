#pragma once
#include "render/pass.h"

namespace cuticle::render::pixel_depth {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::pixel_depth
