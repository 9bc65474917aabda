#pragma once
#include "render/pass.h"

namespace cuticle::render::reference {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::reference
