#pragma once
#include <vector>

#include "render/pass.h"
#include "strands/mesh.h"

namespace cuticle::render::head {

/// The registry's entry of the pass.
const Pass& entry();

/// Per vertex of the head: 1 on the scalp (may be null), falling to 0 between .8 and 1.8 cm from it, so that the
/// hairline is soft.
std::vector<float> scalp_shares(const strands::Mesh& head, const strands::Mesh* scalp);

}  // namespace cuticle::render::head
