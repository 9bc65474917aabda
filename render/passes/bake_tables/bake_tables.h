#pragma once
#include "render/pass.h"

namespace cuticle::render::bake_tables {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::bake_tables
