#version 460
#extension GL_GOOGLE_include_directive : require
// Two triangles a segment: the rectangle of texels whose centres its footprint reaches.
#define MAP_IS_DRAWN
#include "shadows/map_segment.glsl"

layout(location = 0) flat out vec4 one_end;     // x, y, depth step; half width
layout(location = 1) flat out vec4 other_end;   // x, y, depth step
layout(location = 2) flat out uvec2 is_tip;     // of the strand, at either end

const vec2 k_corners[6] = vec2[](vec2(0, -1), vec2(1, -1), vec2(0, 1), vec2(0, 1), vec2(1, -1), vec2(1, 1));
const float k_reach = 0.52;  // half a texel, and what snapping to the raster's grid may take

void main() {
  const MapSegment segment = map_segment(uint(gl_VertexIndex) / 6u);
  const Footprint footprint = segment_footprint(segment.a, segment.b, segment.half_width, segment.is_first ? 1.0 : 0.0,
                                                segment.is_last ? 1.0 : 0.0);
  one_end = vec4(segment.a, segment.half_width);
  other_end = vec4(segment.b, 0);
  is_tip = uvec2(segment.is_first, segment.is_last);
  const vec2 corner = k_corners[gl_VertexIndex % 6];
  const float along = corner.x < 0.5 ? footprint.start - k_reach : footprint.end + k_reach;
  const float across = corner.y * (footprint.half_width + k_reach);
  const vec2 normal = vec2(-footprint.direction.y, footprint.direction.x);
  const vec2 texel = footprint.from + footprint.direction * along + normal * across;
  gl_Position = vec4(2.0 * texel / float(push.resolution) - 1.0, 0.5, 1.0);
}
