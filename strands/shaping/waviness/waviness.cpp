#include "strands/shaping/shaping.h"
#include "strands/shaping/waviness/waviness.glslh"

namespace cuticle::strands::waviness {

namespace {

using registry::Parameter;

constexpr std::string_view k_systems[] = {"H9"};
constexpr Parameter k_parameters[] = {
    {.name = "amplitude",
     .unit = "m",
     .minimum = 0,
     .maximum = 0.1,
     .default_text = "0.006",
     .summary = "height of a wave"},
    {.name = "wavelength",
     .unit = "m",
     .minimum = 0.002,
     .maximum = 2,
     .default_text = "0.05",
     .summary = "length of the strand to a wave"},
    {.name = "onset",
     .unit = "m",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.05",
     .summary = "length over which the amplitude is reached"},
    {.name = "variation",
     .unit = "1",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.3",
     .summary = "difference of amplitude and wavelength between locks"},
    {.name = "phase_variation",
     .unit = "1",
     .minimum = 0,
     .maximum = 1,
     .default_text = "1",
     .summary = "difference of phase between locks; 0: all rise together"},
};

Shaper make(const registry::ParameterValues& values) {
  const float amplitude = float(values.real("amplitude")), wavelength = float(values.real("wavelength"));
  const float onset = float(values.real("onset")), variation = float(values.real("variation"));
  const float spread = float(values.real("phase_variation"));
  return [=](const ShapedStrand& strand) {
    const ShapingChance chance = shaping_chance(strand, strand.leader, "waviness");
    const float height = amplitude * (1 + variation * (chance.a - 0.5f));
    const float waves = 1 / (wavelength * (1 + variation * (chance.b - 0.5f)));
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      strand.points[i] += wave_offset<float>(strand.normals[i], strand.binormals[i], strand.travelled[i], height, waves,
                                             6.2831853f * spread * chance.c, 6.2831853f * chance.d, onset);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping{{.kind = registry::EntryKind::effect,
                                .name = "waviness",
                                .summary = "waves that locks share",
                                .source = "a sine in a plane of the parallel-transported frame of the lock",
                                .parameters = k_parameters,
                                .stage = registry::Stage::generate,
                                .systems = k_systems},
                               40,
                               make};
  return shaping;
}

}  // namespace cuticle::strands::waviness
