#version 460
#extension GL_GOOGLE_include_directive : require
// H15: one thread per strand: centre, half extent and largest radius of its vertices, then these in 12 bytes each.
#include "gpu/groups.glsl"
#include "strands/packing/packing.glslh"

layout(local_size_x = 64) in;
#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, binding = 2) writeonly buffer PackedVertices { uint words[]; };         // three a vertex
layout(std430, binding = 3) writeonly buffer PackedStrands { float strand_units[]; };  // five a strand
layout(push_constant) uniform Constants { uint strands; uint count; };

void main() {
  const uint strand = invocation();
  if (strand >= strands) return;
  const uint first = strand * count;
  vec4 lower = drawn_vertex(first), upper = lower;
  for (uint i = 1u; i < count; ++i) {
    lower = min(lower, drawn_vertex(first + i));
    upper = max(upper, drawn_vertex(first + i));
  }
  const vec3 center = 0.5 * lower.xyz + 0.5 * upper.xyz;
  const vec3 side = max(upper.xyz - center, center - lower.xyz);
  const float extent = max(side.x, max(side.y, side.z)), radius = upper.w;
  strand_units[5u * strand] = center.x;
  strand_units[5u * strand + 1u] = center.y;
  strand_units[5u * strand + 2u] = center.z;
  strand_units[5u * strand + 3u] = extent;
  strand_units[5u * strand + 4u] = radius;
  for (uint v = first; v < first + count; ++v) {
    const vec4 vertex = drawn_vertex(v);
    const vec3 place = extent > 0.0 ? (vertex.xyz - center) / extent : vec3(0.0);
    words[3u * v] = packHalf2x16(place.xy);
    words[3u * v + 1u] = packHalf2x16(vec2(place.z, radius > 0.0 ? vertex.w / radius : 0.0));
    words[3u * v + 2u] = packed_tangent(drawn_tangent(v).xyz);
  }
}
