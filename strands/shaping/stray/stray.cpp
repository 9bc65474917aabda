#include "strands/shaping/shaping.h"
#include "strands/shaping/stray/stray.glslh"

namespace cuticle::strands::stray {

namespace {

using registry::Parameter;

constexpr std::string_view k_systems[] = {"H17"};
constexpr Parameter k_parameters[] = {
    {.name = "share",
     .unit = "1",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.05",
     .summary = "of the strands that stray"},
    {.name = "reach",
     .unit = "m",
     .minimum = 0,
     .maximum = 0.3,
     .default_text = "0.03",
     .summary = "how far their tips leave, at most"},
};

Shaper make(const registry::ParameterValues& values) {
  const float share = float(values.real("share")), reach = float(values.real("reach"));
  return [=](const ShapedStrand& strand) {
    const ShapingChance chance = shaping_chance(strand, strand.strand, "stray");
    if (chance.a >= share) return;
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += stray_offset<float>(strand.normals[i], strand.binormals[i], strand.place(i), reach * chance.b,
                                              6.2831853f * chance.c);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping{{.kind = registry::EntryKind::effect,
                                .name = "stray",
                                .summary = "some strands leave the others",
                                .source = "stray curves: docs/systems.md, H17",
                                .parameters = k_parameters,
                                .stage = registry::Stage::generate,
                                .systems = k_systems},
                               50,
                               make};
  return shaping;
}

}  // namespace cuticle::strands::stray
