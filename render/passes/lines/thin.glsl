// A strand thinner than its line takes a share of the line's samples: as many as its opacity in the mean over texels, by
// a sequence of low discrepancy (Roberts 2018: R2) that begins at a place of the strand's own; which of a texel's, by
// chance. Segments of a strand that meet in a texel take the same samples. Before this stand k_samples and
// strand_chance's mixed().

uint texel_chance(uvec2 texel, uint strand_bits) {
  uint bits = texel.x * 0x9E3779B1u + texel.y * 0x85EBCA77u + strand_bits;
  bits = (bits ^ (bits >> 15)) * 0x2C1B3C6Du;
  bits = (bits ^ (bits >> 12)) * 0x297A2D39u;
  return bits ^ (bits >> 15);
}

// Bits of a texel's samples that a strand covers.
uint samples_of(float share, float strand_chance) {
  const uint all = (1u << k_samples) - 1u;
  if (share >= 1.0) return all;
  const uvec2 texel = uvec2(gl_FragCoord.xy);
  // Golden-ratio steps in 32-bit integers: exact for any texel.
  const uint place = texel.x * 3242174889u + texel.y * 2447445414u + uint(strand_chance * 16777216.0) * 256u;
  const float wanted = max(share, 0.0) * float(k_samples) + float(place >> 8) * (1.0 / 16777216.0);
  const uint count = min(uint(wanted), k_samples), mask = (1u << count) - 1u;
  const uint turn = texel_chance(texel, floatBitsToUint(strand_chance)) % k_samples;
  return (mask << turn | mask >> (k_samples - turn)) & all;
}
