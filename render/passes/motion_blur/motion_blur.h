#pragma once
#include "render/pass.h"

namespace cuticle::render::motion_blur {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::motion_blur
