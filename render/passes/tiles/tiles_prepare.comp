#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: what the tiles that it lies in need of it, so that none projects it again.
#extension GL_EXT_control_flow_attributes : require
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
layout(constant_id = 2) const uint k_has_colors = 1u;  // 0: they are not known yet, and stand as black
#define COLOR_OF(vertex) (k_has_colors != 0u ? texelFetch(colors, int(vertex)).rgb : vec3(0.0))
#include "render/passes/tiles/projected_segment_vertices.glsl"

layout(binding = 2) uniform usamplerBuffer segments;
layout(std430, binding = 3) writeonly buffer Records { uvec4 records[]; };  // those that one binding holds
layout(constant_id = 0) const uint k_first = 0u;
layout(constant_id = 1) const uint k_count = 0u;

void main() {
  uint segment = invocation();
  if (segment >= push.segment_count) return;
  uint vertex = texelFetch(segments, int(segment * k_parts)).r, place = record_place(vertex) - k_first;
  if (place >= k_count) return;
  uvec4 record[k_record_texels] = record_of(segment_from_vertex(vertex));
  [[unroll]] for (uint texel = 0u; texel < k_record_texels; ++texel)
    records[k_record_texels * place + texel] = record[texel];
}
