#version 460
// A card's pixel where its own alpha says so: opaque parts, or the rest.
#extension GL_GOOGLE_include_directive : require
#include "render/passes/cards/cards_shade.glsl"

void main() {
  const vec4 texel = texture(atlas_texture, uv_open.xy);
  color = shaded(texel);  // before the test: one shader does both, as where an alpha test follows it
  if ((texel.a >= atlas.w) != is_opaque) discard;
}
