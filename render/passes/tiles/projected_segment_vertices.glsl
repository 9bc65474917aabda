// Segments from their vertices.
#include "render/passes/tiles/projected_segment.glsl"

layout(binding = 0) uniform samplerBuffer vertices;
layout(binding = 1) uniform samplerBuffer colors;

ProjectedSegment segment_from_vertex(uint vertex) {
  return projected_segment(texelFetch(vertices, int(vertex)), texelFetch(vertices, int(vertex + 1u)),
                          texelFetch(colors, int(vertex)).rgb, texelFetch(colors, int(vertex + 1u)).rgb);
}
