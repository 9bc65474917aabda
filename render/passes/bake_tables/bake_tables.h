#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::bake_tables {

struct Parameters {
  static constexpr std::string_view name = "bake_tables";
  bool mip_levels = false;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::bake_tables
