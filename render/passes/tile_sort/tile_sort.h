#pragma once
#include "render/pass.h"

namespace cuticle::render::tile_sort {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::tile_sort
