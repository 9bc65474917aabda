#pragma once
#include <string_view>

#include "render/pass.h"

namespace cuticle::render::velocity {

/// The registry's entry of the pass.
const Pass& entry();

/// What it writes per pixel, as EXR names it: how far what the pixel sees of the hair has moved on the screen since the
/// frame before, pixels, right and down. 0 where no hair is seen.
inline constexpr std::string_view k_channels[] = {"velocity.X", "velocity.Y"};

}  // namespace cuticle::render::velocity
