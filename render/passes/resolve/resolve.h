#pragma once
#include <glm/vec3.hpp>

#include "core/image/image.h"
#include "render/pass.h"

namespace cuticle::render::resolve {

/// The registry's entry of the pass.
const Pass& entry();
/// Behind a picture (R, G, B, A, premultiplied by coverage) that the CPU made: the background, opaque; black is none.
void add_background(Image& image, const glm::dvec3& background);

}  // namespace cuticle::render::resolve
