#pragma once
#include "render/pass.h"

namespace cuticle::render::surface_shadow {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::surface_shadow
