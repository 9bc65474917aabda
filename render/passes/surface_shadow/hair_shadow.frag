#version 460
#extension GL_GOOGLE_include_directive : require
// A strand covers a texel with its crossing's opacity as the chance, so that the share of texels which none of n strands
// covers is (1 - alpha)^n in the mean.
#define MAPS_BINDING 0
#include "render/passes/surface_shadow/surface_maps.glsl"
#include "render/randomness/strand_chance.glsl"
#include "render/passes/surface_shadow/hair_push.glsl"
layout(location = 0) flat in uint light;
layout(location = 1) flat in uint strand;
layout(location = 2) flat in uint opacity;

// Chance is that of the texel in all maps, so that a strand covers what it covers with a lower opacity.
void main() {
  const vec2 place = gl_FragCoord.xy - vec2(0.0, float(opacity) * map_texture_size.y);
  const uvec2 texel = uvec2(place);
  const float own_alpha = alpha[k_different == 1u ? 0u : opacity];
  if (place.y < 0.0 || !in_own_map(place, light) || mixed(strand, texel.y << 16 | texel.x) >= own_alpha) discard;
}
