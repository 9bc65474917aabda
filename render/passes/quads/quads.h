#pragma once
#include "render/pass.h"

namespace cuticle::render::quads {

struct Parameters {
  static constexpr std::string_view name = "quads";
  int samples = 4;
  double root_width = 1, tip_width = 1, taper_power = 1, full_px = 0;
};
void describe(registry::Members& members, Parameters& parameters);

inline constexpr std::uint32_t k_corners = 6;  ///< of a segment's two triangles

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::quads
