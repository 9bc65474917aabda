#include "strands/shaping/texture/texture.glslh"
#include "strands/shaping/shaping.h"

namespace cuticle::strands::texture {

namespace {

constexpr std::string_view k_systems[] = {"H17"};
struct Parameters {
  float amplitude = 0.0005f;
  double wavelength = 0.02;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.amplitude, "amplitude", "m", 0, 0.02, "of the roughness");
  members(p.wavelength, "wavelength", "m", 0.001, 0.5, "of its longest wave");
}

Shaper make(const Parameters& p) {
  const float waves = float(1 / p.wavelength);
  return [=](const ShapedStrand& strand) {
    const ShapingChance chance = shaping_chance(strand, strand.strand, "texture");
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += texture_offset<float>(strand.normals[i], strand.binormals[i], strand.travelled[i],
                                                p.amplitude, waves, chance.a, chance.b);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping = shaping_of<Parameters, make>({.name = "texture",
                                                               .summary = "roughness of each strand on its own",
                                                               .source = "strand texture: docs/systems.md, H17",
                                                               .systems = k_systems},
                                                              60);
  return shaping;
}

}  // namespace cuticle::strands::texture
