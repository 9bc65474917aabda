#pragma once
#include "render/pass.h"

namespace cuticle::render::cull_strands {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::cull_strands
