#version 460
#extension GL_GOOGLE_include_directive : require
// The angles between the fibre at a vertex, one light and the eye, as bsdf/gpu/evaluate.comp reads its points; one
// invocation per vertex, of all or of a list.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/strand_shading/frame.glsl"
#include "render/randomness/strand_chance.glsl"

#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, set = 0, binding = 2) writeonly buffer Points { float points[]; };  // six each: bsdf::Point
layout(std430, set = 0, binding = 4) readonly buffer List { uint list_count, list_groups[3], list[]; };
layout(push_constant) uniform Push {
  uint light;
  uint is_listed;  // 1: points of the listed vertices alone, in their order
};

// By tangents, which stay exact where a sine or a cosine is nearly 1.
float inclination(vec3 w, vec3 t, vec3 across) { return atan(dot(w, t), length(across)); }

void main() {
  uint place = invocation(), vertex = place;
  if (place >= vertex_count) return;
  // Past the list's end its last vertex stands again: whole workgroups are evaluated.
  if (is_listed != 0u) vertex = list[min(place, list_count - 1u)];
  vec3 t = normalize(drawn_tangent(vertex).xyz + tilt_of(vertex / vertices_per_strand, variation));
  vec3 to_eye = normalize(eye.xyz - drawn_vertex(vertex).xyz);
  vec3 to_light = arriving_at(drawn_vertex(vertex).xyz, lights[light]).to_light;
  vec3 across_i = to_light - dot(to_light, t) * t, across_o = to_eye - dot(to_eye, t) * t;
  float theta_i = inclination(to_light, t, across_i), theta_o = inclination(to_eye, t, across_o);
  float turned = length(cross(across_i, across_o)), phi = turned > 0.0 ? atan(turned, dot(across_i, across_o)) : 0.0;
  if (turned == 0.0 && dot(across_i, across_o) < 0.0) phi = 3.14159265;
  uint first = 6u * place;
  points[first] = theta_i;
  points[first + 1u] = theta_o;
  points[first + 2u] = 0.5 * (theta_o - theta_i);
  points[first + 3u] = phi;
  points[first + 4u] = points[first + 5u] = 0.0;  // the far field; a flat fibre is the mean over its turns
}
