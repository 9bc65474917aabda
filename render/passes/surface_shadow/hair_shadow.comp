#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment and light: a strip that faces the light, as wide as the strand, leaves its depth in the
// texels whose middles it covers. A strand covers a texel with its crossing's opacity as the chance, so that the share
// of texels which none of n strands covers is (1 - alpha)^n in the mean (Enderton et al. 2010).
#define MAPS_BINDING 0
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/finite.glsl"
#include "render/passes/surface_shadow/surface_maps.glsl"
#include "render/randomness/strand_chance.glsl"
#define VERTICES_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, set = 0, binding = 2) readonly buffer Segments { uint segments[]; };
layout(std430, set = 0, binding = 3) buffer Depths { uint depths[]; };  // bits of numbers that are not negative
#include "render/passes/surface_shadow/hair_push.glsl"

// From texels to the strip: how far along it a point lies, 0 at its first end and 1 at its last; and how far to its
// side, 1 at the edge where it is widest. Both are linear in the texels.
struct Strip {
  vec3 along, aside;  // of x, y, 1
  vec2 edge, depth;   // at the first end, and change to the last
  vec2 low, high;     // texels that it may cover
};

vec3 texel_of(uint light, vec3 world) {
  const vec4 at = world_to_map[light] * vec4(world, 1.0);
  return at.w > 0.0 ? at.xyz / at.w : vec3(-1.0);
}

// The linear function that is 0 along `axis` through a point, and 1 at the point + `to`.
vec3 linear(vec2 axis, vec2 to, vec2 point) {
  const float area = to.x * axis.y - to.y * axis.x;
  const vec2 slope = vec2(axis.y, -axis.x) / area;
  return vec3(slope, -dot(slope, point));
}

bool strip_of(uint light, uint first, out Strip strip) {
  const vec4 begin = drawn_vertex(first), end = drawn_vertex(first + parts);
  const vec3 sight = map_sight[light].xyz + map_sight[light].w * begin.xyz;
  const vec3 across = cross(end.xyz - begin.xyz, sight);
  const float size = length(across), widest = max(begin.w, end.w);
  const vec3 a = texel_of(light, begin.xyz), b = texel_of(light, end.xyz);
  const vec2 axis = b.xy - a.xy, side = texel_of(light, begin.xyz + across * (widest * width / size)).xy - a.xy;
  strip.along = linear(side, axis, a.xy);
  strip.aside = linear(axis, side, a.xy);
  strip.edge = vec2(begin.w, end.w - begin.w) / widest;
  strip.depth = vec2(a.z, b.z - a.z);
  strip.low = min(a.xy, b.xy) - abs(side);
  strip.high = max(a.xy, b.xy) + abs(side);
  // Comparisons with what is not a number are false.
  return is_finite(begin) && is_finite(end) && min(a.z, b.z) >= 0.0 && abs(axis.x * side.y - axis.y * side.x) > 0.0 &&
         dot(strip.along, strip.along) + dot(strip.aside, strip.aside) < 1e30;
}

// Narrows an interval of x to where f >= 0 on a row.
void hold(vec3 f, float y, inout vec2 interval) {
  const float rest = f.y * y + f.z, at = -rest / f.x;
  if (f.x > 0.0) interval.x = max(interval.x, at);
  if (f.x < 0.0) interval.y = min(interval.y, at);
  if (f.x == 0.0 && rest < 0.0) interval = vec2(1.0, 0.0);
}

// The first and the one past the last texel of a row whose middles the strip covers.
ivec2 covered_texels(Strip strip, int row, ivec2 own) {
  const float y = float(row) + 0.5;
  vec2 interval = vec2(strip.low.x, strip.high.x);
  const vec3 one = vec3(0.0, 0.0, 1.0), edge = strip.edge.x * one + strip.edge.y * strip.along;
  hold(strip.along, y, interval);
  hold(one - strip.along, y, interval);
  hold(edge - strip.aside, y, interval);
  hold(edge + strip.aside, y, interval);
  return clamp(ivec2(ceil(clamp(interval, -1e6, 1e6) - 0.5)), own.x, own.y);
}

void leave(Strip strip, uint strand, ivec2 texel) {
  const float along = dot(strip.along, vec3(vec2(texel) + 0.5, 1.0)), depth = strip.depth.x + along * strip.depth.y;
  const float chance = mixed(strand, uint(texel.y) << 16 | uint(texel.x));  // of the texel in the maps of all opacities
  for (uint k = 0u; k < k_different; ++k) {
    const uint row = uint(texel.y) + k * uint(map_texture_size.y) - first_row;
    if (chance < alpha[k] && row < row_count && depth >= 0.0)
      atomicMin(depths[row * uint(map_texture_size.x) + uint(texel.x)], floatBitsToUint(depth));
  }
}

void main() {
  const uint place = invocation();
  if (place >= segment_count * light_count) return;
  const uint light = place / segment_count, segment = place % segment_count;
  const uint first = segments[segment * parts], strand = first / vertices_per_strand;
  Strip strip;
  if (!strip_of(light, first, strip)) return;
  const ivec2 corner = ivec2(light % map_columns, light / map_columns) * int(map_resolution),
              end = corner + int(map_resolution);
  const int last = min(int(ceil(min(strip.high.y, 1e6) - 0.5)), end.y);
  for (int row = max(int(ceil(max(strip.low.y, -1e6) - 0.5)), corner.y); row < last; ++row) {
    const ivec2 covered = covered_texels(strip, row, ivec2(corner.x, end.x));
    for (int x = covered.x; x < covered.y; ++x) leave(strip, strand, ivec2(x, row));
  }
}
