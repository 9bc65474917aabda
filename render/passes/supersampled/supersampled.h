#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::supersampled {

struct Parameters {
  static constexpr std::string_view name = "supersampled";
  std::uint32_t samples = 16;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::supersampled
