#pragma once
#include "render/pass.h"

namespace cuticle::render::truth {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::truth
