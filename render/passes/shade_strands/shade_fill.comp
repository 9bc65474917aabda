#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the colours of those that are seen and not shaded, from the shading points beside them.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/randomness/strand_chance.glsl"

#define TANGENTS_BINDING 0
#include "strands/spline/drawn.glsl"
layout(std430, binding = 1) readonly buffer Visible { uint visible[]; };
layout(std430, binding = 2) readonly buffer Points { uint points[]; };
layout(std430, binding = 3) buffer Colors { uvec2 colors[]; };  // of this dispatch's strands
layout(push_constant) uniform Push {
  uint first_vertex, part_vertices;  // of this dispatch
  uint vertices_per_strand;
  float tip_variation;
  uint only_visible;
};
#include "render/passes/shade_strands/shading_points.glsl"

vec3 color_of(uint vertex) {
  const uvec2 packed_color = colors[vertex - first_vertex];
  return vec3(unpackHalf2x16(packed_color.x), unpackHalf2x16(packed_color.y).x);
}

void main() {
  uint place = invocation(), vertex = first_vertex + place;
  if (place >= part_vertices || (only_visible != 0u && (visible[vertex >> 5] >> (vertex & 31u) & 1u) == 0u)) return;
  uint strand = vertex / vertices_per_strand, root = strand * vertices_per_strand, n = points[strand];
  uint p = point_before(vertex - root, n), before = root + vertex_of_point(p, n);
  if (before == vertex) return;
  uint after = root + vertex_of_point(p + 1u, n);
  vec3 color = mix(color_of(before), color_of(after), float(vertex - before) / float(after - before));
  float kept = drawn_tangent(vertex).w <= kept_length(strand, tip_variation) ? 1.0 : 0.0;
  colors[place] = uvec2(packHalf2x16(color.rg), packHalf2x16(vec2(color.b, kept)));
}
