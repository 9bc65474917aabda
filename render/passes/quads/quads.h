#pragma once
#include "render/pass.h"

namespace cuticle::render::quads {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::quads
