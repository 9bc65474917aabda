#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::cull_strands {

struct Parameters {
  static constexpr std::string_view name = "cull_strands";
  bool wanted = true;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::cull_strands
