// The colour of a segment at a point of its axis, so many pixels from the middle and with that 1 / depth: linear from end
// to end on the screen; of one that has parts, linear from vertex to vertex.
#include "render/passes/tiles/vertex_colors.glsl"

// Of a segment in parts, in the places of colour and change: how many parts lie before the point that is `at` pixels from
// the middle is x + (y + at * z) / (1 / depth there), in perspective.
vec3[2] parts_of(ProjectedSegment own, float per_pixel) {
  float last = own.inverse_depth + own.depth_slope * own.half_length;
  float span = float(k_parts) * (own.first.y - own.first.x) * last;
  return vec3[2](vec3(float(k_parts) * own.first.x, 0.5 * span, span * per_pixel), vec3(0.0));
}
float parts_before(Prepared own, float at, float inverse_depth) {
  return clamp(own.shade.x + (own.shade.y + at * own.shade.z) / inverse_depth, 0.0, float(k_parts));
}

uint part_of(float parts) { return min(uint(parts), k_parts - 1u); }

// The vertex before the point.
uint vertex_at(Prepared own, float at, float inverse_depth) {
  return k_parts > 1u ? own.vertex + part_of(parts_before(own, at, inverse_depth)) : own.vertex;
}

vec3 color_at(Prepared own, float at, float inverse_depth) {
  if (k_parts == 1u) return own.shade.rgb + at * own.slope.rgb;
  float parts = parts_before(own, at, inverse_depth);
  uint part = part_of(parts);
  int before = int(own.vertex + part);
  return mix(texelFetch(colors, before).rgb, texelFetch(colors, before + 1).rgb, parts - float(part));
}
