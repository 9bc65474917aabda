#version 460
#extension GL_GOOGLE_include_directive : require
// One thread per drawn vertex: its velocity from those of its three smoothed control hairs, as its position is.
#include "gpu/groups.glsl"
#include "strands/spline/bezier.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Smoothed { vec4 smoothed[]; };       // hairs x vertices: velocity
layout(std430, binding = 1) readonly buffer Hairs { uint hairs[]; };             // three per drawn strand
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };        // three per drawn strand
layout(std430, binding = 3) writeonly buffer Velocities { vec4 velocities[]; };  // of this dispatch's strands, m/s
layout(push_constant) uniform Constants { uint first_strand; uint strands; uint count; };

void main() {
  const uint vertex = invocation();
  if (vertex >= strands * count) return;
  const uint k = 3u * (first_strand + vertex / count), i = vertex % count;
  const uvec3 at = uvec3(hairs[k], hairs[k + 1u], hairs[k + 2u]) * count + i;
  const vec3 weight = vec3(weights[k], weights[k + 1u], weights[k + 2u]);
  velocities[vertex] = vec4(blend_three(smoothed[at.x].xyz, smoothed[at.y].xyz, smoothed[at.z].xyz, weight), 0.0);
}
