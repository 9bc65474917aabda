#version 460
#extension GL_GOOGLE_include_directive : require
// Two triangles a segment: the rectangle of texels whose centres its footprint reaches.
#define MAP_IS_DRAWN
#include "cuticle/shadows/map_segment.glsl"

layout(location = 0) flat out vec4 axis;      // Footprint: from, direction
layout(location = 1) flat out vec4 extent;    // start, end, size, half_width
layout(location = 2) flat out vec2 at_depth;  // depth, slope

const vec2 k_corners[6] = vec2[](vec2(0, -1), vec2(1, -1), vec2(0, 1), vec2(0, 1), vec2(1, -1), vec2(1, 1));
const float k_reach = 0.52;  // half a texel, and what snapping to the raster's grid may take

void main() {
  const MapSegment segment = map_segment(uint(gl_VertexIndex) / 6u, push.count);
  const Footprint footprint = segment_footprint(segment.a, segment.b, segment.half_width, segment.is_first ? 1.0 : 0.0,
                                                segment.is_last ? 1.0 : 0.0);
  axis = vec4(footprint.from, footprint.direction);
  extent = vec4(footprint.start, footprint.end, footprint.size, footprint.half_width);
  at_depth = vec2(footprint.depth, footprint.slope);
  const vec2 corner = k_corners[gl_VertexIndex % 6];
  const float along = corner.x < 0.5 ? footprint.start - k_reach : footprint.end + k_reach;
  const float across = corner.y * (footprint.half_width + k_reach);
  const vec2 normal = vec2(-footprint.direction.y, footprint.direction.x);
  const vec2 texel = footprint.from + footprint.direction * along + normal * across;
  gl_Position = vec4(2.0 * texel / float(push.resolution) - 1.0, 0.5, 1.0);
}
