// A line's pixel: scattering from lookup tables along the interpolated tangent; CHANNELS as in lines_vertex.glsl. With
// SAYS_SEEN also which segment a sample sees, into a visibility buffer.
#extension GL_GOOGLE_include_directive : require
#include "render/strand_shading/frame.glsl"

layout(set = 0, binding = 10) uniform sampler2D table_first;
layout(set = 0, binding = 11) uniform sampler2D table_second;
layout(set = 0, binding = 12) uniform sampler2D table_rest;
layout(constant_id = 6) const uint k_mip_levels = 0u;  // 1: of the tables
#define MIP_LEVELS k_mip_levels
#define LAYOUT_CONSTANT 10
#include "render/strand_shading/scattering.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 tangent;
layout(location = 2) flat in float brightness;
layout(location = 3) in vec4 reached[2 * CHANNELS];
layout(location = 3 + 2 * CHANNELS) in vec3 at_vertex;
layout(constant_id = 4) const uint k_dual = 0u;  // 1: `at_vertex` in place of the frame's `multiple`
layout(constant_id = 8) const uint k_samples = 1u;  // of a texel
layout(constant_id = 9) const uint k_direct = 0u;   // 1: `at_vertex` is all of the light
layout(location = 5 + 2 * CHANNELS) in float opacity;
layout(location = 6 + 2 * CHANNELS) flat in float chance;
#include "render/passes/lines/thin.glsl"
layout(location = 0) out vec4 color;
#ifdef SAYS_SEEN
layout(location = 4 + 2 * CHANNELS) flat in uint id;
layout(location = 1) out uint seen;
#endif

vec3 share_of(uint light) {
  vec3 share;
  for (uint c = 0u; c < 3u; ++c) {
    const uint n = CHANNELS * light + min(c, CHANNELS - 1u);
    share[c] = reached[n >> 2][n & 3u];
  }
  return share;
}

void main() {
  const uint samples = samples_of(opacity, chance);
  if (samples == 0u) discard;
  gl_SampleMask[0] = int(samples);
  vec3 t = normalize(tangent);
  if (k_mip_levels != 0u) {
    tangent_right = dFdx(t);
    tangent_below = dFdy(t);
  }
  vec3 to_eye = normalize(eye.xyz - position);
  vec3 sum = k_dual + k_direct != 0u ? max(at_vertex, 0.0) : vec3(0.0);
  for (uint k = 0u; k < light_count && k_direct == 0u; ++k) {
    vec3 transmittance = clamp(share_of(k), 0.0, 1.0);  // a sample beside the line extrapolates
    const Arriving arriving = arriving_at(position, lights[k]);
    sum += k_dual == 0u ? shade(arriving, transmittance, t, to_eye) : shade_single_scattering(arriving, transmittance, t, to_eye);
  }
  color = vec4(held_by_halves(sum * brightness), 1.0);
#ifdef SAYS_SEEN
  seen = id;
#endif
}
