#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel: the knots of its visibility function, within the bound, from its sorted list.
layout(local_size_x = 64) in;
#include "shadows/deep_shadow/slopes.glslh"
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) readonly buffer First { uint first[]; };
layout(std430, binding = 1) readonly buffer Fragments { uvec2 fragments[]; };
layout(std430, binding = 2) writeonly buffer Counts { uint counts[]; };  // of knots
layout(std430, binding = 3) writeonly buffer Knots { uint knots[]; };    // a texel's at most two a fragment

struct Point {
  float depth, visibility;
};
Point start, last;  // of the piece: its first knot, and the point before
Slopes slopes;
uint begin_of_knots, count;

void emit(Point knot) {
  const uint visibility = uint(floor(65535.0 * clamp(knot.visibility, 0.0, 1.0) + 0.5));
  knots[begin_of_knots + count] = uint(clamp(knot.depth, 0.0, 65535.0)) << 16 | visibility;
  ++count;
}

Point end_of_piece() {
  return Point(last.depth, start.visibility + best_slope(slopes) * (last.depth - start.depth));
}

void take(Point point, float bound) {
  Slopes next = slopes_through(slopes, point.depth - start.depth, point.visibility - start.visibility, bound);
  if (next.least > next.greatest) {
    start = end_of_piece();
    emit(start);
    next = slopes_through(slopes_up_to(0.0), point.depth - start.depth, point.visibility - start.visibility, bound);
  }
  slopes = next;
  last = point;
}

/// Each fragment lowers the visibility over the step that holds it; fragments of one step do so together.
void compress(uint begin, uint end, float bound) {
  start = Point(float(fragments[begin].x), 1.0);
  last = start;
  slopes = slopes_up_to(0.0);
  count = 0u;
  emit(start);
  for (uint i = begin; i < end; ++i) {
    const uint depth = fragments[i].x;
    if (i + 1u < end && fragments[i + 1u].x == depth) continue;
    if (last.depth < float(depth)) take(Point(float(depth), last.visibility), bound);
    take(Point(float(depth + 1u), exp(push.per_unit * float(fragments[i].y))), bound);
  }
  emit(end_of_piece());
}

void main() {
  const uint t = invocation();
  if (t >= push.count) return;
  const uint begin = min(first[t], push.layers), end = min(first[t + 1u], push.layers);
  begin_of_knots = 2u * begin;
  count = 0u;
  const float least_bound = 1e-3, pieces = push.own[1];
  if (begin < end) compress(begin, end, push.own[0]);
  for (float bound = push.own[0]; float(count) > pieces + 1.0;) {
    bound = max(least_bound, 1.5 * bound);
    compress(begin, end, bound);
  }
  counts[t] = count;
}
