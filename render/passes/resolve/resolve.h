#pragma once
#include <glm/vec3.hpp>

#include "core/image/image.h"
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::resolve {

struct Parameters {
  static constexpr std::string_view name = "resolve";
  glm::dvec3 background{0};
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();
/// Behind a picture (R, G, B, A, premultiplied by coverage) that the CPU made: the background, opaque; black is none.
void add_background(Image& image, const glm::dvec3& background);

}  // namespace cuticle::render::resolve
