#version 460
#extension GL_GOOGLE_include_directive : require
// N5: one thread per run of vertices of a drawn strand: position, radius, tangent and fraction of the length. Within a
// run each vertex is blended once; the neighbours beyond its ends are blended again, which is cheaper than a barrier.
#include "gpu/groups.glsl"
#include "strands/spline/bezier.glslh"
#include "strands/tangent.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Smoothed { vec4 smoothed[]; };   // hairs x vertices: position, fraction
layout(std430, binding = 1) readonly buffer Hairs { uint hairs[]; };         // three per drawn strand
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };    // three per drawn strand
layout(std430, binding = 3) writeonly buffer Vertices { vec4 vertices[]; };  // of this dispatch's strands: position, radius
layout(std430, binding = 4) writeonly buffer Tangents { vec4 tangents[]; };  // unit tangent, fraction of the length
layout(push_constant) uniform Constants { uint first_strand; uint strands; uint count; uint run; float radius; float tip_radius; };

vec4 blended(uvec3 first, vec3 weight, uint i) {
  const vec4 a = smoothed[first.x + i], b = smoothed[first.y + i], c = smoothed[first.z + i];
  return vec4(blend_three(a.xyz, b.xyz, c.xyz, weight), dot(weight, vec3(a.w, b.w, c.w)));
}

void main() {
  const uint thread = invocation(), runs = (count + run - 1u) / run;
  if (thread >= strands * runs) return;
  const uint strand = thread / runs, begin = (thread % runs) * run, end = min(begin + run, count);
  const uint k = 3u * (first_strand + strand);
  const uvec3 first = uvec3(hairs[k], hairs[k + 1u], hairs[k + 2u]) * count;
  const vec3 weight = vec3(weights[k], weights[k + 1u], weights[k + 2u]);
  const vec3 root = blended(first, weight, 0u).xyz, tip = blended(first, weight, count - 1u).xyz;
  vec4 here = blended(first, weight, begin);
  vec4 before = blended(first, weight, begin == 0u ? 0u : begin - 1u);
  for (uint i = begin; i < end; ++i) {
    const vec4 after = blended(first, weight, min(i + 1u, count - 1u));
    vertices[strand * count + i] = vec4(here.xyz, mix(radius, tip_radius, here.w));
    tangents[strand * count + i] = vec4(vertex_tangent(before.xyz, after.xyz, root, tip), here.w);
    before = here;
    here = after;
  }
}
