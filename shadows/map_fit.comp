#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per 16 vertices: the box of all vertices along the light's axes. Minima of integers, so any order gives the same.
layout(local_size_x = 64) in;
#include "shadows/map_geometry.glsl"

#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
layout(std430, binding = 1) buffer Box { uint least[6]; };

shared uint group_least[6];

const uint k_vertices_each = 16u;  // of an invocation; map_shadow_gpu.h
const float k_far = 3e38;

void main() {
  const uint lane = gl_LocalInvocationID.x;
  if (lane < 6u) group_least[lane] = 0xffffffffu;
  barrier();
  vec3 lower = vec3(k_far), upper = vec3(-k_far);
  const uint first = k_vertices_each * invocation();
  for (uint v = first; v < min(first + k_vertices_each, push.count); ++v) {
    const vec3 point = in_light_axes(drawn_vertex(v).xyz);
    if (!is_seen_by_light(point, push.reach)) continue;
    lower = min(lower, point);
    upper = max(upper, point);
  }
  if (first < push.count)
    for (int axis = 0; axis < 3; ++axis) {
      atomicMin(group_least[axis], ordered_bits(lower[axis]));
      atomicMin(group_least[axis + 3], ordered_bits(-upper[axis]));
    }
  barrier();
  if (lane < 6u) atomicMin(least[lane], group_least[lane]);
}
