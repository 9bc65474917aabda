#version 460
#extension GL_GOOGLE_include_directive : require
// N5: one workgroup per drawn strand, one thread per vertex: position, radius, tangent and fraction of the length.
#include "cuticle/strands/spline/bezier.glslh"
#include "cuticle/strands/tangent.glslh"

layout(local_size_x_id = 0) in;  // vertices per strand, at most 64
layout(std430, binding = 0) readonly buffer Smoothed { vec4 smoothed[]; };   // hairs x vertices
layout(std430, binding = 1) readonly buffer Hairs { uint hairs[]; };         // three per drawn strand
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };    // three per drawn strand
layout(std430, binding = 3) writeonly buffer Vertices { vec4 vertices[]; };  // position, radius
layout(std430, binding = 4) writeonly buffer Tangents { vec4 tangents[]; };  // unit tangent, fraction of the length
layout(push_constant) uniform Constants { uint strands; float radius; float tip_radius; };

shared vec3 points[64];

vec3 corner(uint strand, uint k, uint i) { return smoothed[hairs[3u * strand + k] * gl_WorkGroupSize.x + i].xyz; }

vec3 blended(uint strand, uint i) {
  const vec3 weight = vec3(weights[3u * strand], weights[3u * strand + 1u], weights[3u * strand + 2u]);
  return blend_three(corner(strand, 0u, i), corner(strand, 1u, i), corner(strand, 2u, i), weight);
}

// Arc length before vertex i over the whole; by count of vertices where the strand has no length.
float fraction_of_length(uint i, uint last) {
  float before = 0.0, whole = 0.0;
  for (uint k = 0u; k < last; ++k) {
    whole += distance(points[k], points[k + 1u]);
    if (k + 1u == i) before = whole;
  }
  return whole > 0.0 ? before / whole : float(i) / float(last);
}

void main() {
  const uint strand = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint i = gl_LocalInvocationID.x, last = gl_WorkGroupSize.x - 1u;
  const bool drawn = strand < strands;
  if (drawn) points[i] = blended(strand, i);
  barrier();
  if (!drawn) return;
  const float fraction = fraction_of_length(i, last);
  const vec3 tangent = vertex_tangent(points[i == 0u ? 0u : i - 1u], points[min(i + 1u, last)], points[0], points[last]);
  const uint vertex = strand * gl_WorkGroupSize.x + i;
  vertices[vertex] = vec4(points[i], mix(radius, tip_radius, fraction));
  tangents[vertex] = vec4(tangent, fraction);
}
