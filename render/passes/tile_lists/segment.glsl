// A strand's segment on the screen. Depth is kept as 1 / distance along the view, which is linear on the screen.
#include "render/finite.glsl"
#include "render/passes/tile_lists/tile_push.glsl"

struct Projected {
  vec2 direction, middle;  // of its axis, pixels; unit
  float half_length;
  float half_width, width_slope;     // at the middle; per pixel along the axis
  float inverse_depth, depth_slope;
  vec2 shares;                       // of the way from end to end that is in view, at its two ends
};

const float k_guard = 4.0;      // the axis is cut this many half screens from the middle, where floats are still fine
const float k_cap = 0.7853982, k_longest_cap = 0.5;  // what is drawn beyond the axis' ends: half widths; pixels, at most
const float k_shortest = 1e-6;  // pixels; a shorter axis has no direction

// A round end covers as much as a rectangle so long.
float cap_of(float half_width) { return min(k_cap * half_width, k_longest_cap); }

// The part of `range` where a value, linear from 0 to 1, is not negative.
vec2 cut(vec2 range, float at_0, float at_1) {
  float crossing = at_0 / (at_0 - at_1);
  if (at_0 < 0.0) range.x = at_1 < 0.0 ? 2.0 : max(range.x, crossing);
  if (at_1 < 0.0) range.y = min(range.y, at_0 < 0.0 ? -1.0 : crossing);
  return range;
}

// Between the near and the far plane and not far beside the screen; empty where the second is below the first.
vec2 part_in_view(vec4 a, vec4 b) {
  vec2 range = vec2(0.0, 1.0);
  range = cut(range, a.w * push.inverse_near - 1.0, b.w * push.inverse_near - 1.0);
  range = cut(range, 1.0 - a.w * push.inverse_far, 1.0 - b.w * push.inverse_far);
  for (int axis = 0; axis < 2; ++axis) {
    range = cut(range, k_guard * a.w - a[axis], k_guard * b.w - b[axis]);
    range = cut(range, k_guard * a.w + a[axis], k_guard * b.w + b[axis]);
  }
  return range;
}

// False where nothing of the segment (position and radius of its ends) is in view or it has no width.
bool project(vec4 a, vec4 b, out Projected p) {
  vec4 clip_a = push.world_to_clip * vec4(a.xyz, 1.0), clip_b = push.world_to_clip * vec4(b.xyz, 1.0);
  p.shares = part_in_view(clip_a, clip_b);
  vec4 first = mix(clip_a, clip_b, p.shares.x), last = mix(clip_a, clip_b, p.shares.y);
  vec2 inverse = vec2(1.0 / first.w, 1.0 / last.w);
  vec2 from = (first.xy * inverse.x * 0.5 + 0.5) * vec2(push.resolution);
  vec2 to = (last.xy * inverse.y * 0.5 + 0.5) * vec2(push.resolution);
  float len = length(to - from);
  p.direction = len > k_shortest ? (to - from) / len : vec2(1.0, 0.0);
  p.middle = 0.5 * (from + to);
  p.half_length = 0.5 * len;
  float per_pixel = len > k_shortest ? 1.0 / len : 0.0;
  vec2 half_widths = mix(vec2(a.w), vec2(b.w), p.shares) * inverse * push.pixel_scale / push.kept_share;
  p.half_width = 0.5 * (half_widths.x + half_widths.y);
  p.width_slope = (half_widths.y - half_widths.x) * per_pixel;
  p.inverse_depth = 0.5 * (inverse.x + inverse.y);
  p.depth_slope = (inverse.y - inverse.x) * per_pixel;
  return p.shares.x < p.shares.y && p.half_width > 0.0;
}
