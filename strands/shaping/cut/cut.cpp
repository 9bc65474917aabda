#include <algorithm>
#include <vector>

#include <glm/common.hpp>

#include "strands/shaping/shaping.h"
#include "strands/shaping/cut/cut.glslh"

namespace cuticle::strands::cut {

namespace {

using registry::Parameter;

constexpr std::string_view k_systems[] = {"H9"};
constexpr Parameter k_parameters[] = {
    {.name = "variation",
     .unit = "1",
     .minimum = 0,
     .maximum = 0.95,
     .default_text = "0.3",
     .summary = "largest share of a strand that is cut off"},
    {.name = "profile",
     .unit = "1",
     .minimum = 0.1,
     .maximum = 8,
     .default_text = "1",
     .summary = "above 1: few strands short, below 1: few long"},
};

/// The points resampled to the first `share` of their polyline (by vertices), as many as before.
void keep(std::span<glm::vec3> points, float share) {
  const std::vector<glm::vec3> whole(points.begin(), points.end());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const float place = float(i) * share;
    const auto before = std::size_t(place);
    points[i] = glm::mix(whole[before], whole[std::min(before + 1, whole.size() - 1)], place - float(before));
  }
}

Shaper make(const registry::ParameterValues& values) {
  const float variation = float(values.real("variation")), profile = float(values.real("profile"));
  return [=](const ShapedStrand& strand) {
    keep(strand.points, kept_share<float>(variation, shaping_chance(strand, strand.strand, "cut").a, profile));
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping{{.kind = registry::EntryKind::effect,
                                .name = "cut",
                                .summary = "drawn strands cut to different lengths, last of all effects",
                                .source = "length variation: docs/systems.md, H9",
                                .parameters = k_parameters,
                                .stage = registry::Stage::generate,
                                .systems = k_systems},
                               90,
                               make};
  return shaping;
}

}  // namespace cuticle::strands::cut
