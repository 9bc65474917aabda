#include "strands/shaping/shaping.h"
#include "strands/shaping/curl/curl.glslh"

namespace cuticle::strands::curl {

namespace {

using registry::Parameter;

constexpr std::string_view k_systems[] = {"H9"};
constexpr Parameter k_parameters[] = {
    {.name = "radius", .unit = "m", .minimum = 0, .maximum = 0.05, .default_text = "0.008", .summary = "of the helix"},
    {.name = "pitch",
     .unit = "m",
     .minimum = 0.001,
     .maximum = 1,
     .default_text = "0.03",
     .summary = "length of the strand to a turn"},
    {.name = "onset",
     .unit = "m",
     .minimum = 0,
     .maximum = 0.5,
     .default_text = "0.03",
     .summary = "length over which the radius is reached"},
    {.name = "variation",
     .unit = "1",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.2",
     .summary = "difference of radius and pitch between locks"},
    {.name = "frizz",
     .unit = "1",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.1",
     .summary = "share of the curl that each strand of a lock winds on its own"},
};

/// What chance makes of a helix for one lock or strand.
struct Helix {
  float radius, turns, phase;
};

Helix helix_of(const ShapingChance& chance, float radius, float pitch, float variation) {
  const float sense = chance.d < 0.5f ? 1.0f : -1.0f;
  return {radius * (1 + variation * (chance.a - 0.5f)), sense / (pitch * (1 + variation * (chance.b - 0.5f))),
          6.2831853f * chance.c};
}

Shaper make(const registry::ParameterValues& values) {
  const float radius = float(values.real("radius")), pitch = float(values.real("pitch"));
  const float onset = float(values.real("onset")), variation = float(values.real("variation"));
  const float frizz = float(values.real("frizz"));
  return [=](const ShapedStrand& strand) {
    const Helix lock = helix_of(shaping_chance(strand, strand.leader, "curl"), radius * (1 - frizz), pitch, variation);
    const Helix own = helix_of(shaping_chance(strand, strand.strand, "frizz"), radius * frizz, pitch, variation);
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      for (const Helix& helix : {lock, own})
        strand.points[i] += curl_offset<float>(strand.normals[i], strand.binormals[i], strand.travelled[i],
                                               helix.radius, helix.turns, helix.phase, onset);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping{{.kind = registry::EntryKind::effect,
                                .name = "curl",
                                .summary = "locks or single strands wound to helices",
                                .source = "a helix about the parallel-transported frame of the lock",
                                .parameters = k_parameters,
                                .stage = registry::Stage::generate,
                                .systems = k_systems},
                               30,
                               make};
  return shaping;
}

}  // namespace cuticle::strands::curl
