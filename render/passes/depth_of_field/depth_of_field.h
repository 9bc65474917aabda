#pragma once
#include "render/pass.h"

namespace cuticle::render::depth_of_field {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::depth_of_field
