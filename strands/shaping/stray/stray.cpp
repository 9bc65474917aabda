#include "strands/shaping/stray/stray.glslh"
#include "strands/shaping/shaping.h"

namespace cuticle::strands::stray {

namespace {

constexpr std::string_view k_systems[] = {"H17"};
struct Parameters {
  float share = 0.05f, reach = 0.03f;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.share, "share", "1", 0, 1, "of the strands that stray");
  members(p.reach, "reach", "m", 0, 0.3, "how far their tips leave, at most");
}

Shaper make(const Parameters& p) {
  return [=](const ShapedStrand& strand) {
    const ShapingChance chance = shaping_chance(strand, strand.strand, "stray");
    if (chance.a >= p.share) return;
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += stray_offset<float>(strand.normals[i], strand.binormals[i], strand.place(i),
                                              p.reach * chance.b, 6.2831853f * chance.c);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping = shaping_of<Parameters, make>({.name = "stray",
                                                               .summary = "some strands leave the others",
                                                               .source = "stray curves: docs/systems.md, H17",
                                                               .systems = k_systems},
                                                              50);
  return shaping;
}

}  // namespace cuticle::strands::stray
