#pragma once
#include "render/pass.h"

namespace cuticle::render::fins {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::fins
