#version 460
// The depth of opaque parts, by their alpha alone.
#extension GL_GOOGLE_include_directive : require
#include "render/passes/cards/cards_frame.glsl"

layout(location = 3) in vec3 uv_open;

void main() {
  if (texture(atlas_texture, uv_open.xy).a < atlas.w) discard;
}
