#version 460
#extension GL_GOOGLE_include_directive : require
// A strand covers a texel with its crossing's opacity as the chance, so that the share of texels which none of n strands
// covers is (1 - alpha)^n in the mean.
#define MAPS_BINDING 0
#include "cuticle/render/passes/surface_shadow/surface_maps.glsl"
#include "cuticle/render/passes/lines/strand_chance.glsl"
layout(push_constant) uniform Push {
  uint vertices_per_strand;
  float width;
  float alpha;
};
layout(location = 0) flat in uint light;
layout(location = 1) flat in uint strand;

void main() {
  const uvec2 texel = uvec2(gl_FragCoord.xy);
  if (!in_own_map(gl_FragCoord.xy, light) || mixed(strand, texel.y << 16 | texel.x) >= alpha) discard;
}
