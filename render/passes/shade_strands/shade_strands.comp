#version 460
#extension GL_GOOGLE_include_directive : require
// Shading in strand space: one invocation per vertex, of all or of a list; segments interpolate between the colours of
// their ends.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/strand_shading/frame.glsl"
#include "render/randomness/strand_chance.glsl"

#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, set = 0, binding = 2) writeonly buffer Colors { uvec2 colors[]; };  // of this dispatch: r g b, 1 where the strand is kept
layout(std430, set = 0, binding = 5) readonly buffer Visible { uint visible[]; };  // a bit per vertex
layout(std430, set = 0, binding = 6) readonly buffer Shaded { uint shaded_count, unused[3], shaded[]; };
layout(set = 0, binding = 10) uniform sampler2D table_first;
layout(set = 0, binding = 11) uniform sampler2D table_second;
layout(set = 0, binding = 12) uniform sampler2D table_rest;
layout(constant_id = 6) const uint k_direct = 0u;  // 1: `scattered` in place of the tables
layout(push_constant) uniform Push {
  uint only_visible;
  uint first_vertex, part_vertices;  // of those whose colours this dispatch writes
  uint listed;  // 1: the vertices of the list `shaded`; 2: of which S by the model's formulas stands in the same order
};
#define SCATTERED_BINDING 9
#include "render/strand_shading/scattered.glsl"
#define CHANNEL_CONSTANT 2
#define TRANSMITTANCE_BINDING 4
#include "render/strand_shading/transmittance.glsl"
vec3 evaluated = vec3(0.0);
#define EVALUATED k_direct != 0u
#define LAYOUT_CONSTANT 7
#include "render/strand_shading/scattering.glsl"
#define DUAL_CONSTANT 0
#define DUAL_BINDING 7
#include "render/passes/dual_scattering/lit.glsl"

void main() {
  uint place = invocation(), vertex = first_vertex + place;
  if (place >= (listed != 0u ? shaded_count : part_vertices)) return;
  if (listed != 0u) vertex = shaded[place];
  if (vertex - first_vertex >= part_vertices) return;  // below the first: a large number
  if (listed == 0u && only_visible != 0u && (visible[vertex >> 5] >> (vertex & 31u) & 1u) == 0u) return;
  uint strand = vertex / vertices_per_strand;
  vec3 t = normalize(drawn_tangent(vertex).xyz + tilt_of(strand, variation));
  vec3 to_eye = normalize(eye.xyz - drawn_vertex(vertex).xyz);
  vec3 sum = vec3(0.0);
  uint k = 0u;
  do {  // a loop that asks before its first turn runs its body once more on lavapipe, masked
    if (k_direct != 0u && k < light_count) evaluated = scattered_at(k, listed == 2u ? place : vertex);
    if (k < light_count)
      sum += lit(arriving_at(drawn_vertex(vertex).xyz, lights[k]), transmitted(k, vertex), past_surfaces(k, vertex), t, to_eye);
  } while (++k < light_count);
  vec3 radiance = held_by_halves(sum * brightness_of(strand, variation));
  float kept = drawn_tangent(vertex).w <= kept_length(strand, tip_variation) ? 1.0 : 0.0;
  colors[vertex - first_vertex] = uvec2(packHalf2x16(radiance.rg), packHalf2x16(vec2(radiance.b, kept)));
}
