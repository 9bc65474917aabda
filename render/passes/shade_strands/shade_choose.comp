#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per strand: how many shading points it has, by its length on the screen were it drawn across the view
// where it is nearest, and which of them are next to a vertex that is seen.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"

#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
layout(std430, binding = 1) readonly buffer Visible { uint visible[]; };    // a bit per vertex
layout(std430, binding = 2) writeonly buffer Points { uint points[]; };     // per strand
layout(std430, binding = 3) buffer Shaded { uint shaded_count, unused[3], shaded[]; };  // vertices, in any order
layout(push_constant) uniform Push {
  vec3 eye;
  float points_per_size;  // points = 1 + this * length / distance
  uint strand_count, vertices_per_strand;
  uint only_visible;
};
#include "render/passes/shade_strands/shading_points.glsl"

bool is_seen(uint vertex) { return only_visible == 0u || (visible[vertex >> 5] >> (vertex & 31u) & 1u) != 0u; }

uint point_count(uint root) {
  float len = 0.0, nearest = distance(drawn_vertex(root).xyz, eye);
  for (uint k = 1u; k < vertices_per_strand; ++k) {
    len += distance(drawn_vertex(root + k - 1u).xyz, drawn_vertex(root + k).xyz);
    nearest = min(nearest, distance(drawn_vertex(root + k).xyz, eye));
  }
  float wanted = 1.0 + ceil(points_per_size * len / nearest);
  // Comparisons with what is not a number are false: such a strand has all its points.
  return wanted < float(vertices_per_strand) ? uint(max(wanted, 2.0)) : vertices_per_strand;
}

void main() {
  uint strand = invocation();
  if (strand >= strand_count) return;
  uint root = strand * vertices_per_strand, n = point_count(root);
  points[strand] = n;
  for (uint p = 0u; p < n; ++p) {
    uint own = vertex_of_point(p, n);
    uint first = p == 0u ? 0u : vertex_of_point(p - 1u, n) + 1u;
    uint end = p + 1u < n ? vertex_of_point(p + 1u, n) : own + 1u;
    bool needed = false;
    for (uint k = first; k < end; ++k) needed = needed || is_seen(root + k);
    if (needed) shaded[atomicAdd(shaded_count, 1u)] = root + own;
  }
}
