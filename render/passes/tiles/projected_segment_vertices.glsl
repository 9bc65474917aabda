// Segments from their vertices.
#include "render/passes/tiles/projected_segment.glsl"

#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
#include "render/passes/tiles/vertex_colors.glsl"

#ifndef COLOR_OF  // a vertex's colour, where not all are wanted
#define COLOR_OF(vertex) texelFetch(colors, int(vertex)).rgb
#endif

ProjectedSegment segment_from_vertex(uint vertex) {
  vec4 a = drawn_vertex(vertex), b = drawn_vertex(vertex + k_parts);
  if (k_parts > 1u) return projected_segment(a, b, vec3(0.0), vec3(0.0));
  return projected_segment(a, b, COLOR_OF(vertex), COLOR_OF(vertex + 1u));
}
