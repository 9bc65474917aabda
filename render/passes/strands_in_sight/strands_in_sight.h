#pragma once
#include "core/registry/members.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::strands_in_sight {

struct Parameters {
  static constexpr std::string_view name = "strands_in_sight";
  bool wanted = true;
};
void describe(registry::Members& members, Parameters& parameters);

/// The drawn strands that may be in the picture.
struct StrandsInSight;
constexpr std::string_view resource_name(const StrandsInSight*) { return "strands_in_sight"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::strands_in_sight
