#ifndef CUTICLE_RENDER_STROKE_GLSL
#define CUTICLE_RENDER_STROKE_GLSL
// A segment as it is drawn in any tile.
#include "render/passes/tile_lists/segment.glsl"
#include "render/passes/tile_lists/segment_parts.glsl"

// The axis: pixel q lies cross(xy, q) + z across it and dot(xy, q) + w along it. Widths and 1 / depth are at its middle,
// and change per pixel; colours are at its ends. In parts it has those of its vertices instead (part_colors.glsl), and
// first.xy are the shares of the way from vertex to vertex at which the ends of what is in view lie.
struct ProjectedSegment {
  vec4 axis;
  float half_length, half_width, width_slope, inverse_depth, depth_slope;
  vec3 first, last;
};

// The segment that begins with a vertex; `first` and `last` are the colours of its vertices.
ProjectedSegment projected_segment(vec4 a, vec4 b, vec3 first, vec3 last) {
  Projected p;
  project(a, b, p);
  vec3 from = k_parts > 1u ? vec3(p.shares, 0.0) : mix(first, last, p.shares.x);
  vec3 to = k_parts > 1u ? vec3(0.0) : mix(first, last, p.shares.y);
  return ProjectedSegment(vec4(p.direction, p.direction.y * p.middle.x - p.direction.x * p.middle.y, -dot(p.direction, p.middle)),
                p.half_length, p.half_width, p.width_slope, p.inverse_depth, p.depth_slope,
                from, to);
}

// As three texels of a buffer; colours as halves, which they are at vertices.
const uint k_record_texels = 3u;
uint record_place(uint vertex) { return vertex / k_parts; }
uvec3 recorded_ends(ProjectedSegment own) {
  if (k_parts > 1u) return uvec3(floatBitsToUint(own.first.xy), 0u);
  return uvec3(packHalf2x16(own.first.rg), packHalf2x16(vec2(own.first.b, own.last.r)), packHalf2x16(own.last.gb));
}
uvec4[k_record_texels] record_of(ProjectedSegment own) {
  return uvec4[k_record_texels](
      floatBitsToUint(own.axis),
      floatBitsToUint(vec4(own.half_length, own.half_width, own.width_slope, own.inverse_depth)),
      uvec4(floatBitsToUint(own.depth_slope), recorded_ends(own)));
}
ProjectedSegment recorded_segment(uvec4 a, uvec4 b, uvec4 c) {
  vec4 sizes = uintBitsToFloat(b);
  vec2 middle = unpackHalf2x16(c.z);
  vec3 from = k_parts > 1u ? vec3(uintBitsToFloat(c.yz), 0.0) : vec3(unpackHalf2x16(c.y), middle.x);
  vec3 to = k_parts > 1u ? vec3(0.0) : vec3(middle.y, unpackHalf2x16(c.w));
  return ProjectedSegment(uintBitsToFloat(a), sizes.x, sizes.y, sizes.z, sizes.w, uintBitsToFloat(c.x), from, to);
}
#endif
