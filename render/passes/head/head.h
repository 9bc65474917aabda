#pragma once
#include <vector>

#include "core/registry/members.h"
#include "render/pass.h"
#include "strands/mesh.h"

namespace cuticle::render::head {

struct Parameters {
  static constexpr std::string_view name = "head";
  glm::dvec3 skin{0.42, 0.27, 0.2}, scalp{0.05, 0.033, 0.02};
  double wrap = 0.4, ambient = 0.12, bleed = 0;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

/// Per vertex of the head: 1 on the scalp (may be null), falling to 0 between .8 and 1.8 cm from it, so that the
/// hairline is soft.
std::vector<float> scalp_shares(const strands::Mesh& head, const strands::Mesh* scalp);

}  // namespace cuticle::render::head
