#pragma once
#include "render/pass.h"

namespace cuticle::render::ambient_occlusion {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::ambient_occlusion
