#include "strands/shaping/clumping/clumping.h"
#include "strands/shaping/clumping/clumping.glslh"

namespace cuticle::strands::clumping {

namespace {

constexpr std::string_view k_systems[] = {"H9"};

Shaper make(const Parameters& p) {
  return [=](const ShapedStrand& strand) {
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] +=
          clumped_point<float>(strand.base[i], strand.leader_base[i], strand.place(i), p.strength, p.profile) -
          strand.base[i];
  };
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.strands_per_lock, "strands_per_lock", "1", 1, 1000, "mean number of strands of a lock");
  members(p.strength, "strength", "1", 0, 1, "how far tips move to the leader");
  members(p.profile, "profile", "1", 0.1, 8, "place where a lock closes: below 1 near the root, above 1 near the tip");
}

const Shaping& entry() {
  static const Shaping shaping = shaping_of<Parameters, make>({.name = "clumping",
                                                               .summary = "strands gather to the leader of their lock",
                                                               .source = "clumping: docs/systems.md, H9",
                                                               .systems = k_systems},
                                                              10);
  return shaping;
}

}  // namespace cuticle::strands::clumping
