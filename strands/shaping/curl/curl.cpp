#include "strands/shaping/curl/curl.glslh"
#include "strands/shaping/shaping.h"

namespace cuticle::strands::curl {

namespace {

constexpr std::string_view k_systems[] = {"H9"};
struct Parameters {
  float radius = 0.008f, pitch = 0.03f, onset = 0.03f, variation = 0.2f, frizz = 0.1f;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.radius, "radius", "m", 0, 0.05, "of the helix");
  members(p.pitch, "pitch", "m", 0.001, 1, "length of the strand to a turn");
  members(p.onset, "onset", "m", 0, 0.5, "length over which the radius is reached");
  members(p.variation, "variation", "1", 0, 1, "difference of radius and pitch between locks");
  members(p.frizz, "frizz", "1", 0, 1, "share of the curl that each strand of a lock winds on its own");
}

/// What chance makes of a helix for one lock or strand.
struct Helix {
  float radius, turns, phase;
};

Helix helix_of(const ShapingChance& chance, float radius, float pitch, float variation) {
  const float sense = chance.d < 0.5f ? 1.0f : -1.0f;
  return {radius * (1 + variation * (chance.a - 0.5f)), sense / (pitch * (1 + variation * (chance.b - 0.5f))),
          6.2831853f * chance.c};
}

Shaper make(const Parameters& p) {
  return [=](const ShapedStrand& strand) {
    const Helix lock =
        helix_of(shaping_chance(strand, strand.leader, "curl"), p.radius * (1 - p.frizz), p.pitch, p.variation);
    const Helix own =
        helix_of(shaping_chance(strand, strand.strand, "frizz"), p.radius * p.frizz, p.pitch, p.variation);
    for (std::size_t i = 1; i < strand.points.size(); ++i)
      for (const Helix& helix : {lock, own})
        strand.points[i] += curl_offset<float>(strand.normals[i], strand.binormals[i], strand.travelled[i],
                                               helix.radius, helix.turns, helix.phase, p.onset);
  };
}

}  // namespace

const Shaping& entry() {
  static const Shaping shaping =
      shaping_of<Parameters, make>({.name = "curl",
                                    .summary = "locks or single strands wound to helices",
                                    .source = "a helix about the parallel-transported frame of the lock",
                                    .systems = k_systems},
                                   30);
  return shaping;
}

}  // namespace cuticle::strands::curl
