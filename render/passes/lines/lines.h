#pragma once
#include "render/pass.h"

namespace cuticle::render::lines {

struct Parameters {
  static constexpr std::string_view name = "lines";
  double width_px = 0, widest_px = 4, full_px = 0;
  bool packed = false;
  double tip_variation = 0, ambient = 0.6, variation = 0;
};
void describe(registry::Members& members, Parameters& parameters);

inline constexpr std::uint32_t k_corners = 2;  ///< of a segment

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::lines
