#pragma once
#include "core/registry/members.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::bake_tables {

struct Parameters {
  static constexpr std::string_view name = "bake_tables";
  bool mip_levels = false;
};
void describe(registry::Members& members, Parameters& parameters);

/// The lookup tables of the material.
struct Tables;
constexpr std::string_view resource_name(const Tables*) { return "tables"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::bake_tables
