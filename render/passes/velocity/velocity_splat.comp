#version 460
#extension GL_GOOGLE_include_directive : require
// Each control vertex's displacement to the eight nodes around it, as integers: the sums are the same in any order.
#include "render/passes/velocity/velocity.glsl"
#include "render/finite.glsl"
layout(binding = 1) uniform samplerBuffer now;
layout(binding = 2) uniform samplerBuffer motion;
layout(std430, binding = 3) readonly buffer Largest { float largest; };
layout(std430, binding = 4) buffer Sums { int sums[]; };  // per node: displacement x, y, z and weight

void main() {
  uint vertex = invocation();
  if (vertex >= vertex_count) return;
  const vec4 place = texelFetch(now, int(vertex)), moves = texelFetch(motion, int(vertex));
  if (!is_finite(place) || !is_finite(moves)) return;
  float unit = 1073741824.0 / float(vertex_count);  // all of them in one node stay below 2^31
  vec3 way = moved(place, moves), share;
  vec4 value = vec4(largest > 0.0 ? way / largest : vec3(0.0), 1.0);
  uvec3 below = node_below(place.xyz, share);
  for (uint corner = 0u; corner < 8u; ++corner) {
    uint node;
    vec4 part = corner_of(below, share, corner, node) * value * unit;
    for (uint k = 0u; k < 4u; ++k) atomicAdd(sums[4u * node + k], int(round(part[k])));
  }
}
