#include "strands/shaping/volume/volume.glslh"
#include "strands/shaping/shaping.h"

namespace cuticle::strands::volume {

namespace {

constexpr std::string_view k_systems[] = {"H17"};
struct Parameters {
  float lift = 0.01f, onset = 0.03f;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.lift, "lift", "m", -0.05, 0.1, "height gained");
  members(p.onset, "onset", "m", 0, 0.5, "length over which it is gained");
}

Shaper make(const Parameters& p) {
  return [=](const ShapedStrand& strand) {
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += volume_offset<float>(strand.root_normal, strand.travelled[i], p.lift, p.onset);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping = shaping_of<Parameters, make>({.name = "volume",
                                                               .summary = "hair lifted off the surface it roots on",
                                                               .source = "volume control: docs/systems.md, H17",
                                                               .systems = k_systems},
                                                              20);
  return shaping;
}

}  // namespace cuticle::strands::volume
