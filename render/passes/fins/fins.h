#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::fins {

struct Parameters {
  static constexpr std::string_view name = "fins";
  glm::dvec3 root{0.1, 0.3, 0.3}, tip{0.5, 0.75, 0.6};
  double through = 0.4, wrap = 0.3, ambient = 0.12;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::fins
