#version 460
// A card follows some of its strands: each row stands by their mean as it stood at rest, turned with the mean's tangent.
#extension GL_GOOGLE_include_directive : require
#include "gpu/groups.glsl"
#include "render/passes/cards/card_rows.glsl"
#include "strands/spline/frame.glslh"

layout(local_size_x = 64) in;
#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
layout(std430, set = 0, binding = 1) readonly buffer Rests { CardRest rests[]; };
layout(std430, set = 0, binding = 2) readonly buffer Followers { uint followers[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Placed { PlacedRow placed[]; };
layout(set = 0, binding = 4) uniform samplerBuffer transmittance;                         // per drawn vertex
layout(std430, set = 0, binding = 5) writeonly buffer Reached { float reached[]; };             // per row
layout(std430, set = 0, binding = 6) readonly buffer Visibility { float visibility[]; };        // per drawn vertex
layout(push_constant) uniform Push {
  mat4 head;  // rest to world
  uint row_count, vertices_per_strand, vertex_count;
  uint shadows;   // lights times different channels; 0: nothing shadows
  uint surfaces;  // lights where surfaces cast; else 0
};

const float k_step = 0.02;  // of v, for tangents; placement_gpu.cpp has the same

// Of a strand: the vertex before v, its vertices taken for even steps, and the share of the way to the next.
struct Step {
  uint begin;
  float share;
};
Step step_at(float v) {
  const float place = clamp(v, 0.0, 1.0) * float(vertices_per_strand - 1u);
  const uint begin = min(uint(place), vertices_per_strand - 2u);
  return Step(begin, place - float(begin));
}

// The followers' mean at v.
vec3 mean_of_followers(uvec2 list, float v) {
  const Step at = step_at(v);
  vec3 sum = vec3(0.0);
  for (uint k = list.x; k < list.y; ++k) {
    const uint vertex = followers[k] * vertices_per_strand + at.begin;
    sum += mix(drawn_vertex(vertex).xyz, drawn_vertex(vertex + 1u).xyz, at.share);
  }
  return sum / float(list.y - list.x);
}

// Of shadow k: first what arrives, then what of a light passes surfaces.
float left_at(uint k, uint vertex) {
  return k < shadows ? texelFetch(transmittance, int(k * vertex_count + vertex)).r : visibility[(k - shadows) * vertex_count + vertex];
}
// What of it is left at them there, in the mean.
float mean_left(uvec2 list, float v, uint shadow) {
  const Step at = step_at(v);
  float sum = 0.0;
  for (uint k = list.x; k < list.y; ++k) {
    const uint vertex = followers[k] * vertices_per_strand + at.begin;
    sum += mix(left_at(shadow, vertex), left_at(shadow, vertex + 1u), at.share);
  }
  return sum / float(list.y - list.x);
}

void main() {
  const uint row = invocation();
  if (row >= row_count) return;
  const CardRest rest = rests[row];
  const float v = rest.correction.w;
  const vec3 ahead = mean_of_followers(rest.followers.xy, v + k_step), behind = mean_of_followers(rest.followers.xy, v - k_step);
  const vec3 along = ahead - behind, from = mat3(head) * rest.follower_tangent.xyz;
  const vec3 to = dot(along, along) > 0.0 ? normalize(along) : from;
  const vec3 hinge = any_across(from);
  const vec3 middle =
      mean_of_followers(rest.followers.xy, v) + transported(mat3(head) * rest.correction.xyz, from, to, hinge);
  const vec3 across = transported(mat3(head) * rest.across.xyz, from, to, hinge);
  const vec3 tangent = transported(mat3(head) * rest.tangent.xyz, from, to, hinge);
  placed[row].left = vec4(middle - rest.across.w * across, rest.tangent.w);
  placed[row].right = vec4(middle + rest.across.w * across, rest.follower_tangent.w);
  placed[row].normal = vec4(cross(tangent, across), 0.0);
  placed[row].tangent = vec4(tangent, 0.0);
  for (uint k = 0u; k < shadows + surfaces; ++k) reached[k * row_count + row] = mean_left(rest.followers.xy, v, k);
}
