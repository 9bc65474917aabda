#include "strands/shaping/shaping.h"
#include "strands/shaping/texture/texture.glslh"

namespace cuticle::strands::texture {

namespace {

using registry::Parameter;

constexpr std::string_view k_systems[] = {"H17"};
constexpr Parameter k_parameters[] = {
    {.name = "amplitude",
     .unit = "m",
     .minimum = 0,
     .maximum = 0.02,
     .default_text = "0.0005",
     .summary = "of the roughness"},
    {.name = "wavelength",
     .unit = "m",
     .minimum = 0.001,
     .maximum = 0.5,
     .default_text = "0.02",
     .summary = "of its longest wave"},
};

Shaper make(const registry::ParameterValues& values) {
  const float amplitude = float(values.real("amplitude")), waves = float(1 / values.real("wavelength"));
  return [=](const ShapedStrand& strand) {
    const ShapingChance chance = shaping_chance(strand, strand.strand, "texture");
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += texture_offset<float>(strand.normals[i], strand.binormals[i], strand.travelled[i], amplitude,
                                                waves, chance.a, chance.b);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping{{.kind = registry::EntryKind::effect,
                                .name = "texture",
                                .summary = "roughness of each strand on its own",
                                .source = "strand texture: docs/systems.md, H17",
                                .parameters = k_parameters,
                                .stage = registry::Stage::generate,
                                .systems = k_systems},
                               60,
                               make};
  return shaping;
}

}  // namespace cuticle::strands::texture
