// Strands as lines: two vertices a segment, pulled from the drawn strands' buffers, in full or packed. Transmittance
// comes per strand vertex, in CHANNELS numbers a light: 1, or 3 where channels are shadowed apart.
#extension GL_GOOGLE_include_directive : require
#include "strands/packing/packing.glslh"
#include "render/finite.glsl"
#include "render/strand_shading/frame.glsl"
#include "render/randomness/strand_chance.glsl"

#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, set = 0, binding = 8) readonly buffer PackedVertices { uint words[]; };  // three a vertex
layout(std430, set = 0, binding = 9) readonly buffer PackedStrands { float strand_units[]; };  // five a strand
#define CHANNEL_CONSTANT 0
#define TRANSMITTANCE_BINDING 2
#include "render/strand_shading/transmittance.glsl"
#include "render/strand_shading/angles.glsl"
#define DUAL_CONSTANT 4
#define DUAL_BINDING 4
#include "render/passes/dual_scattering/multiple_scattering.glsl"
#include "render/strand_shading/ambient.glsl"
layout(constant_id = 9) const uint k_direct = 0u;  // 1: light by `scattered`, for which fragments read no tables
#define SCATTERED_BINDING 7
#include "render/strand_shading/scattered.glsl"

#define LISTED_CONSTANT 7
#define LISTED_BINDING 6
#include "render/passes/cull_strands/listed_strand.glsl"

const uint k_of_opacity = 6u;  // purpose of a chance

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 tangent;
layout(location = 2) flat out float brightness;
layout(location = 3) out vec4 reached[2 * CHANNELS];
layout(location = 3 + 2 * CHANNELS) out vec3 at_vertex;  // radiance by dual scattering, or, of k_direct, all of it
layout(location = 4 + 2 * CHANNELS) flat out uint id;  // of the segment, from 1
layout(location = 5 + 2 * CHANNELS) out float opacity;       // the strand's width over the line's
layout(location = 6 + 2 * CHANNELS) flat out float chance;   // of the strand

vec3 position_of(uint vertex) {
  if (packed_vertices == 0u) return drawn_vertex(vertex).xyz;
  const uint unit = vertex / vertices_per_strand * 5u, xy = words[3u * vertex], z = words[3u * vertex + 1u];
  const float extent = strand_units[unit + 3u];
  return vec3(unpacked_length(xy & 0xffffu, strand_units[unit], extent),
              unpacked_length(xy >> 16, strand_units[unit + 1u], extent),
              unpacked_length(z & 0xffffu, strand_units[unit + 2u], extent));
}
float radius_of(uint vertex) {
  if (packed_vertices == 0u) return drawn_vertex(vertex).w;
  return unpacked_length(words[3u * vertex + 1u] >> 16, 0.0, strand_units[vertex / vertices_per_strand * 5u + 4u]);
}
vec3 tangent_of(uint vertex) {
  return packed_vertices == 0u ? drawn_tangent(vertex).xyz : unpacked_tangent(words[3u * vertex + 2u]);
}
// Of the strand's length; packed strands hold none, and count their vertices.
float fraction_of(uint vertex) {
  return packed_vertices == 0u ? drawn_tangent(vertex).w
                               : float(vertex % vertices_per_strand) / float(max(vertices_per_strand, 2u) - 1u);
}

bool has_numbers(uint vertex) {
  return is_finite(packed_vertices == 0u ? drawn_vertex(vertex) : vec4(position_of(vertex), 0.0));
}

vec3 multiple_scattering_of_lights(uint vertex) {
  const vec3 t = normalize(tangent), to_eye = normalize(eye.xyz - position);
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < light_count; ++k)
    sum += multiple_scattering(arriving_at(position, lights[k]), transmitted(k, vertex), past_surfaces(k, vertex), t, to_eye);
  return sum;
}

// Without dual scattering with the frame's `multiple`, as shade() of scattering.glsl has it.
vec3 light_by_formulas(uint vertex) {
  const vec3 t = normalize(tangent), to_eye = normalize(eye.xyz - position);
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < light_count; ++k) {
    const Arriving arriving = arriving_at(position, lights[k]);
    const vec3 transmittance = transmitted(k, vertex);
    const float sin_i = dot(arriving.to_light, t), cos_i = sqrt(max(1.0 - sin_i * sin_i, 0.0));
    const vec3 unshared = k_dual == 0u ? multiple.rgb * multiple_scattering_share(cos_i, transmittance) : vec3(0.0);
    sum += (scattered_at(k, vertex) * transmittance + unshared) * arriving.irradiance;
  }
  return sum;
}

void main() {
  const uint segment = uint(gl_VertexIndex) >> 1, strand = strand_at(segment / drawn_segments), begin = segment % drawn_segments;
  const uint vertex = vertex_of(strand, begin + (uint(gl_VertexIndex) & 1u));
  id = strand * drawn_segments + begin + 1u;
  position = position_of(vertex);
  tangent = tangent_of(vertex) + tilt_of(strand, variation);
  brightness = brightness_of(strand, variation);
  for (uint k = 0u; k < 8u; ++k) {
    const vec3 share = k < light_count ? transmitted(k, vertex) : vec3(0.0);
    for (uint c = 0u, n = CHANNELS * k; c < CHANNELS; ++c, ++n) reached[n >> 2][n & 3u] = share[c];
  }
  at_vertex = k_dual == 0u ? vec3(0.0) : multiple_scattering_of_lights(vertex);
  if (k_direct != 0u) at_vertex += light_by_formulas(vertex);
  // A segment of a tip that chance cuts away, and one with numbers that are none, lie outside the view.
  const uint other = vertex_of(strand, begin + 1u - (uint(gl_VertexIndex) & 1u));
  const bool kept = fraction_of(vertex_of(strand, begin + 1u)) <= kept_length(strand, tip_variation) &&
                    has_numbers(vertex) && has_numbers(other);
  gl_Position = kept ? world_to_clip * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  opacity = opacity_of_radius > 0.0 ? opacity_of_radius * radius_of(vertex) / max(gl_Position.w, 1e-9) : 1.0;
  chance = mixed(strand, k_of_opacity);
}
