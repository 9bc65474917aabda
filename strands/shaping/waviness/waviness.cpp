#include "strands/shaping/waviness/waviness.glslh"
#include "strands/shaping/shaping.h"

namespace cuticle::strands::waviness {

namespace {

constexpr std::string_view k_systems[] = {"H9"};
struct Parameters {
  float amplitude = 0.006f, wavelength = 0.05f, onset = 0.05f, variation = 0.3f, phase_variation = 1;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.amplitude, "amplitude", "m", 0, 0.1, "height of a wave");
  members(p.wavelength, "wavelength", "m", 0.002, 2, "length of the strand to a wave");
  members(p.onset, "onset", "m", 0, 1, "length over which the amplitude is reached");
  members(p.variation, "variation", "1", 0, 1, "difference of amplitude and wavelength between locks");
  members(p.phase_variation, "phase_variation", "1", 0, 1, "difference of phase between locks; 0: all rise together");
}

Shaper make(const Parameters& p) {
  return [=](const ShapedStrand& strand) {
    const ShapingChance chance = shaping_chance(strand, strand.leader, "waviness");
    const float height = p.amplitude * (1 + p.variation * (chance.a - 0.5f));
    const float waves = 1 / (p.wavelength * (1 + p.variation * (chance.b - 0.5f)));
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += wave_offset<float>(strand.normals[i], strand.binormals[i], strand.travelled[i], height, waves,
                                             6.2831853f * p.phase_variation * chance.c, 6.2831853f * chance.d, p.onset);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping =
      shaping_of<Parameters, make>({.name = "waviness",
                                    .summary = "waves that locks share",
                                    .source = "a sine in a plane of the parallel-transported frame of the lock",
                                    .systems = k_systems},
                                   40);
  return shaping;
}

}  // namespace cuticle::strands::waviness
