// A pixel's strands, each shaded once and counted as often as samples see it. The sum goes to the samples that see hair.
// Before this stand the version, and after it `seen`, the visibility buffer, at binding 10.
#extension GL_GOOGLE_include_directive : require
#include "render/strand_shading/frame.glsl"
#include "render/randomness/strand_chance.glsl"
#include "render/visibility/segment_share.glsl"

layout(constant_id = 0) const int k_samples = 1;
#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(set = 0, binding = 7) uniform sampler2D table_first;
layout(set = 0, binding = 8) uniform sampler2D table_second;
layout(set = 0, binding = 9) uniform sampler2D table_rest;
layout(constant_id = 7) const uint k_direct = 0u;  // 1: `scattered` in place of the tables
#define SCATTERED_BINDING 6
#include "render/strand_shading/scattered.glsl"
#define CHANNEL_CONSTANT 1
#define TRANSMITTANCE_BINDING 2
#include "render/strand_shading/transmittance.glsl"
vec3 evaluated = vec3(0.0);
#define EVALUATED k_direct != 0u
#define LAYOUT_CONSTANT 8
#include "render/strand_shading/scattering.glsl"
#define DUAL_CONSTANT 5
#define DUAL_BINDING 4
#include "render/passes/dual_scattering/lit.glsl"

layout(location = 0) out vec4 color;

/// The segment that a sample sees, from 1; 0: none.
uint segment_at(ivec2 pixel, int sample_index);

vec3 radiance_of(uint segment, vec2 middle, vec2 size) {
  uint strand = segment / drawn_segments, begin = segment % drawn_segments;
  uint first = vertex_of(strand, begin), last = vertex_of(strand, begin + 1u);
  float share = share_at(world_to_clip, middle, size, drawn_vertex(first).xyz, drawn_vertex(last).xyz);
  vec3 t = normalize(mix(drawn_tangent(first).xyz, drawn_tangent(last).xyz, share) + tilt_of(strand, variation));
  vec3 place = mix(drawn_vertex(first).xyz, drawn_vertex(last).xyz, share), to_eye = normalize(eye.xyz - place);
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < light_count; ++k) {
    vec3 transmittance = mix(transmitted(k, first), transmitted(k, last), share);
    if (k_direct != 0u) evaluated = mix(scattered_at(k, first), scattered_at(k, last), share);
    float past = mix(past_surfaces(k, first), past_surfaces(k, last), share);
    sum += lit(arriving_at(place, lights[k]), transmittance, past, t, to_eye);
  }
  return sum * brightness_of(strand, variation);
}

void shade_pixel(ivec2 pixel, vec2 size) {
  uint seen_by[k_samples];
  int mask = 0, hair = 0;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < k_samples; ++k) {
    seen_by[k] = segment_at(pixel, k);
    mask |= seen_by[k] > 0u ? 1 << k : 0;
  }
  for (int k = 0; k < k_samples; ++k) {
    if (seen_by[k] == 0u) continue;
    uint segment = seen_by[k] - 1u;
    int count = 0;
    for (int j = k; j < k_samples; ++j)
      if (seen_by[j] > 0u && (seen_by[j] - 1u) / drawn_segments == segment / drawn_segments) {
        seen_by[j] = 0u;
        ++count;
      }
    sum += float(count) * radiance_of(segment, vec2(pixel) + 0.5, size);
    hair += count;
  }
  if (hair == 0) discard;
  color = vec4(held_by_halves(sum / float(hair)), 1.0);
  gl_SampleMask[0] = mask;
}
