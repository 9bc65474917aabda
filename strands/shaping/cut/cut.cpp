#include <algorithm>
#include <vector>

#include <glm/common.hpp>

#include "strands/shaping/cut/cut.glslh"
#include "strands/shaping/shaping.h"

namespace cuticle::strands::cut {

namespace {

constexpr std::string_view k_systems[] = {"H9"};
struct Parameters {
  float variation = 0.3f, profile = 1;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.variation, "variation", "1", 0, 0.95, "largest share of a strand that is cut off");
  members(p.profile, "profile", "1", 0.1, 8, "above 1: few strands short, below 1: few long");
}

/// The points resampled to the first `share` of their polyline (by vertices), as many as before.
void keep(std::span<glm::vec3> points, float share) {
  const std::vector<glm::vec3> whole(points.begin(), points.end());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const float place = float(i) * share;
    const auto before = std::size_t(place);
    points[i] = glm::mix(whole[before], whole[std::min(before + 1, whole.size() - 1)], place - float(before));
  }
}

Shaper make(const Parameters& p) {
  return [=](const ShapedStrand& strand) {
    keep(strand.points, kept_share<float>(p.variation, shaping_chance(strand, strand.strand, "cut").a, p.profile));
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping =
      shaping_of<Parameters, make>({.name = "cut",
                                    .summary = "drawn strands cut to different lengths, last of all effects",
                                    .source = "length variation: docs/systems.md, H9",
                                    .systems = k_systems},
                                   90);
  return shaping;
}

}  // namespace cuticle::strands::cut
