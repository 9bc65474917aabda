// Differences between strands by chance: the same for every way of drawing them.

#include "render/randomness/mixed_bits.glsl"

// A number in [0, 1) for a strand and a purpose.
float mixed(uint strand, uint purpose) {
  return float(mixed_bits(strand * 0x9E3779B1u + purpose * 0x85EBCA77u) >> 8) * (1.0 / 16777216.0);
}

// Added to a strand's tangents.
vec3 tilt_of(uint strand, float variation) {
  return variation * (vec3(mixed(strand, 0u), mixed(strand, 1u), mixed(strand, 2u)) - 0.5);
}

// Factor on a strand's radiance.
float brightness_of(uint strand, float variation) { return 1.0 + variation * (2.0 * mixed(strand, 3u) - 1.0); }

// Share of its length that a strand keeps where chance cuts its tip.
float kept_length(uint strand, float tip_variation) { return 1.0 - tip_variation * mixed(strand, 4u); }
