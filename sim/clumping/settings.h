#pragma once
// The parameters of clumping.
#include "core/registry/members.h"

namespace cuticle::sim::clumping {

struct Settings {
  static constexpr std::string_view name = "clumping";
  double rate = 20, tightness = 0.8, profile = 1, noise = 0.2;
  std::int64_t strands_per_clump = 12;
  std::uint64_t seed = 1;
};
void describe(registry::Members& members, Settings& settings);

}  // namespace cuticle::sim::clumping
