#version 460
// A segment as two triangles that face the camera. Their sides stand across the strand's tangent, so that neighbours
// share an edge.
#extension GL_GOOGLE_include_directive : require
#include "render/finite.glsl"
#include "render/strand_shading/frame.glsl"
#include "render/randomness/strand_chance.glsl"

#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(set = 0, binding = 5) uniform sampler2D taper;  // factor on the width, root to tip
#define LISTED_CONSTANT 0
#define LISTED_BINDING 4
#include "render/passes/cull_strands/listed_strand.glsl"
layout(push_constant) uniform Push { float width; };   // factor on all

layout(location = 0) flat out uint id;  // of the segment, from 1

const uint k_end[6] = uint[](0u, 0u, 1u, 1u, 0u, 1u);
const float k_side[6] = float[](-1.0, 1.0, -1.0, -1.0, 1.0, 1.0);

// Of unit length, across the strand as it is seen and in the plane of the picture, where it is as wide as the other ways
// to draw take it; any in that plane where the strand points at the eye.
vec3 across(vec3 tangent, vec3 to_eye) {
  vec3 forward = normalize(vec3(world_to_clip[0].w, world_to_clip[1].w, world_to_clip[2].w));
  vec3 side = cross(tangent, to_eye), other = cross(forward, vec3(forward.z, forward.x, -forward.y));
  side -= forward * dot(side, forward);
  return normalize(dot(side, side) > 1e-12 ? side : other);
}

void main() {
  const uint corner = uint(gl_VertexIndex) % 6u, segment = uint(gl_VertexIndex) / 6u;
  const uint strand = strand_at(segment / drawn_segments), begin = segment % drawn_segments;
  const uint first = vertex_of(strand, begin), last = vertex_of(strand, begin + 1u);
  const uint vertex = k_end[corner] == 0u ? first : last;
  id = strand * drawn_segments + begin + 1u;
  const float radius = drawn_vertex(vertex).w * width * textureLod(taper, vec2(drawn_tangent(vertex).w, 0.5), 0.0).r;
  const vec3 side = across(drawn_tangent(vertex).xyz, normalize(eye.xyz - drawn_vertex(vertex).xyz));
  const vec3 position = drawn_vertex(vertex).xyz + side * (k_side[corner] * radius);
  // A segment of a tip that chance cuts away, and one with numbers that are none, lie outside the view.
  const bool drawn = drawn_tangent(last).w <= kept_length(strand, tip_variation) && is_finite(drawn_vertex(first)) &&
                     is_finite(drawn_vertex(last));
  gl_Position = drawn ? world_to_clip * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
