// Scheuermann's shading of a card's pixel: two highlights with tangents shifted along the card's normal, a lerp diffuse
// term, textures, ambient occlusion, and what the scene's shadow method lets through to the strands of the card.
#include "bsdf/scheuermann/scheuermann.glslh"
#include "render/passes/cards/cards_frame.glsl"

layout(constant_id = 0) const bool is_opaque = false;
layout(constant_id = 1) const uint step_number = 0u;
layout(constant_id = 2) const bool counts = false;
layout(constant_id = 3) const bool is_shadowed = false;
#define TRANSMITTANCE_BINDING 5
#define CHANNEL_CONSTANT 4
#include "render/strand_shading/transmittance.glsl"
#include "render/strand_shading/ambient.glsl"
#include "render/strand_shading/angles.glsl"
layout(constant_id = 8) const uint scattered_by = 0u;  // as ScatteredBy of cards_gpu.cpp
const uint k_frame_multiple = 1u, k_dual_scattering = 2u;
layout(constant_id = 9) const bool is_shadowed_by_hair = false;
layout(constant_id = 10) const bool surfaces_cast = false;
#define DUAL_BINDING 6
#include "render/passes/dual_scattering/dual_scattering.glsl"
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tangent;
layout(location = 3) in vec3 uv_open;
layout(location = 4) in float row_at;
layout(location = 0) out vec4 color;

// L + V by its components along the tangent, the normal, and across both.
HalfVector half_vector_on_card(vec3 t, vec3 n, vec3 to_light, vec3 to_eye) {
  const vec3 sum = to_light + to_eye;
  HalfVector v;
  v.along = dot(sum, t);
  v.toward = dot(sum, n);
  v.across = dot(sum, cross(t, n));
  v.length_squared = dot(sum, sum);
  v.cos_normal = dot(to_light, n);
  return v;
}

// The rows that the pixel lies between, and its share of the way; a sample beside the card extrapolates.
struct Rows {
  uint row, next;
  float share;
};
Rows rows_at_pixel() {
  const float at = clamp(row_at, 0.0, float(vertex_count - 1u));
  const uint row = uint(at);
  return Rows(row, min(row + 1u, vertex_count - 1u), at - float(row));
}
vec3 transmittance_of_light(uint light) {
  if (!is_shadowed) return vec3(1.0);
  const Rows rows = rows_at_pixel();
  return mix(transmitted(light, rows.row), transmitted(light, rows.next), rows.share);
}
// What of a light passes the surfaces: behind the transmittance of all lights.
float past_surfaces(uint light) {
  if (!surfaces_cast) return 1.0;
  const Rows rows = rows_at_pixel();
  const uint first = (uint(diffuse.w) * k_different + light) * vertex_count;
  return mix(transmittance_at(first + rows.row), transmittance_at(first + rows.next), rows.share);
}

// Light scattered many times, as strands have it.
vec3 multiple_scattering(vec3 to_light, vec3 transmittance, float past, vec3 t, vec3 to_eye) {
  if (scattered_by == 0u) return vec3(0.0);
  const Angles angles = angles_of(to_light, t, to_eye);
  if (scattered_by == k_dual_scattering) return dual_scattering(angles, transmittance, past);
  return multiple.rgb * multiple_scattering_share(sqrt(max(1.0 - angles.sin_i * angles.sin_i, 0.0)), transmittance);
}

vec4 shaded(vec4 texel) {
  if (counts) atomicAdd(shaded_count[step_number], 1u);
  const vec3 t = normalize(tangent), n = normalize(normal - t * dot(normal, t)), to_eye = normalize(eye.xyz - world);
  const float shift = texel.g - 0.5, open = uv_open.z;
  Scheuermann m;
  m.diffuse = diffuse.rgb;
  m.primary = highlight_moved(primary.rgb, primary.w, shifts.x + shift);
  m.secondary = highlight_moved(secondary.rgb * texel.b, secondary.w, shifts.y + shift);
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < uint(diffuse.w); ++k) {
    const Arriving light = arriving_at(world, lights[k]);
    const vec3 transmittance = transmittance_of_light(k);
    sum += light.irradiance * (scattering_at(m, half_vector_on_card(t, n, light.to_light, to_eye)) * transmittance +
                               multiple_scattering(light.to_light, transmittance, past_surfaces(k), t, to_eye));
  }
  return vec4(held_by_halves(sum * shifts.z * texel.r * (is_shadowed_by_hair ? 1.0 : open)), is_opaque ? 1.0 : texel.a);
}
