#pragma once
#include "core/registry/members.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::shade_strands {

struct Parameters {
  static constexpr std::string_view name = "shade_strands";
  double point_px = 0;
};
void describe(registry::Members& members, Parameters& parameters);

/// Radiance of the vertices of drawn strands.
struct StrandColors;
constexpr std::string_view resource_name(const StrandColors*) { return "strand_colors"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::shade_strands
