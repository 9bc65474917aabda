#pragma once
#include "core/registry/members.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::cull_strands {

struct Parameters {
  static constexpr std::string_view name = "cull_strands";
  bool wanted = true;
};
void describe(registry::Members& members, Parameters& parameters);

/// Which strands a way of drawing has to draw.
struct SeenStrands;
constexpr std::string_view resource_name(const SeenStrands*) { return "seen_strands"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::cull_strands
