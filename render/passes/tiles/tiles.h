#pragma once
#include "render/pass.h"

namespace cuticle::render::tiles {

struct Parameters {
  static constexpr std::string_view name = "tiles";
  double opacity = 1;
  std::uint32_t coverage_rows = 8;
  int chunk_px = 0;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::tiles
