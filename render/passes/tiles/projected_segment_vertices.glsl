// Segments from their vertices.
#include "render/passes/tiles/projected_segment.glsl"

layout(binding = 0) uniform samplerBuffer vertices;
layout(binding = 1) uniform samplerBuffer colors;

#ifndef COLOR_OF  // a vertex's colour, where not all are wanted
#define COLOR_OF(vertex) texelFetch(colors, int(vertex)).rgb
#endif

ProjectedSegment segment_from_vertex(uint vertex) {
  return projected_segment(texelFetch(vertices, int(vertex)), texelFetch(vertices, int(vertex + 1u)), COLOR_OF(vertex),
                           COLOR_OF(vertex + 1u));
}
