#pragma once
#include "render/pass.h"

namespace cuticle::render::dual_scattering {

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::dual_scattering
