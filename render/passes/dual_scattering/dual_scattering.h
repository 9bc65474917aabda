#pragma once
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::dual_scattering {

enum class Corrections : std::uint8_t { none, path_tracing };

struct Parameters {
  static constexpr std::string_view name = "dual_scattering";
  double forward_density = 1, backward_density = 1, direction_spread = 0.4;
  Corrections corrections = Corrections::path_tracing;
};
void describe(registry::Members& members, Parameters& parameters);

/// What dual scattering needs of the material.
struct Terms;
constexpr std::string_view resource_name(const Terms*) { return "dual_scattering"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::dual_scattering
