#pragma once
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::pixel_depth {

/// How far away the nearest thing in each pixel is.
struct PixelDepth;
constexpr std::string_view resource_name(const PixelDepth*) { return "pixel_depth"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::pixel_depth
