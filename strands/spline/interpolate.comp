#version 460
#extension GL_GOOGLE_include_directive : require
// N5: one thread per drawn vertex: position, radius, tangent and fraction of the length. The neighbours that a tangent
// needs are blended again by each thread: on software Vulkan a barrier costs far more than the six loads.
#include "cuticle/strands/spline/bezier.glslh"
#include "cuticle/strands/tangent.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Smoothed { vec4 smoothed[]; };   // hairs x vertices: position, fraction
layout(std430, binding = 1) readonly buffer Hairs { uint hairs[]; };         // three per drawn strand
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };    // three per drawn strand
layout(std430, binding = 3) writeonly buffer Vertices { vec4 vertices[]; };  // position, radius
layout(std430, binding = 4) writeonly buffer Tangents { vec4 tangents[]; };  // unit tangent, fraction of the length
layout(push_constant) uniform Constants { uint strands; uint count; float radius; float tip_radius; };

vec3 blended(uvec3 first, vec3 weight, uint i) {
  return blend_three(smoothed[first.x + i].xyz, smoothed[first.y + i].xyz, smoothed[first.z + i].xyz, weight);
}

vec3 tangent_at(uvec3 first, vec3 weight, uint i) {
  const vec3 before = blended(first, weight, i == 0u ? 0u : i - 1u);
  const vec3 after = blended(first, weight, min(i + 1u, count - 1u));
  vec3 root = before, tip = after;
  if (before == after) {
    root = blended(first, weight, 0u);
    tip = blended(first, weight, count - 1u);
  }
  return vertex_tangent(before, after, root, tip);
}

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint vertex = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (vertex >= strands * count) return;
  const uint strand = vertex / count, i = vertex % count;
  const uvec3 first = uvec3(hairs[3u * strand], hairs[3u * strand + 1u], hairs[3u * strand + 2u]) * count;
  const vec3 weight = vec3(weights[3u * strand], weights[3u * strand + 1u], weights[3u * strand + 2u]);
  const float fraction = dot(weight, vec3(smoothed[first.x + i].w, smoothed[first.y + i].w, smoothed[first.z + i].w));
  vertices[vertex] = vec4(blended(first, weight, i), mix(radius, tip_radius, fraction));
  tangents[vertex] = vec4(tangent_at(first, weight, i), fraction);
}
