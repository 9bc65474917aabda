#version 460
// Cards by their index buffer. The position is the same to the bit in every pass: one compares depths for equality.
#extension GL_GOOGLE_include_directive : require
#include "render/passes/cards/cards_frame.glsl"

invariant gl_Position;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 tangent;
layout(location = 3) out vec3 uv_open;  // place in the atlas, ambient occlusion
layout(location = 4) out float row_at;  // in the list of all rows

void main() {
  const uint vertex = indices[gl_VertexIndex], row = vertex >> 1, side = vertex & 1u;
  const vec4 place = side == 0u ? placed[row].left : placed[row].right;
  world = place.xyz;
  normal = placed[row].normal.xyz;
  tangent = placed[row].tangent.xyz;
  const float u = atlas.x + float(rests[row].followers.z) * atlas.z + float(side) * atlas.y;
  uv_open = vec3(u, rests[row].correction.w, place.w);
  row_at = float(row);
  gl_Position = world_to_clip * vec4(place.xyz, 1.0);
}
