// Marschner scattering from lookup tables by dot products alone (GPU Gems 2, chapter 23): no trigonometry here.
//   sin theta_i = L.T, sin theta_o = E.T, cos phi from the parts of L and E across the fibre, cos theta_d from table M.
// Radiance = sum over lights of S irradiance transmittance: the projection of the light onto the fibre is part of M
// (docs/conventions.md). Before this stand lines_frame.glsl and the samplers table_m (M_R, M_TT, M_TRT, cos theta_d),
// table_n_tt_r (N_TT rgb, N_R) and table_n_trt (N_TRT rgb).
#include "render/passes/lines/ambient.glsl"
#include "render/passes/lines/angles.glsl"

//
// With mip levels a lookup reads a mean over what lies between it and those of the next pixels, where the tangent is
// another: `tangent_right` and `tangent_below` are what is added to it. They are set outside of loops, in which llvmpipe
// leaves zeros beside a line. Half of the way: the tent between texels is twice as wide as they are (README.md).
#ifndef MIP_LEVELS
#define MIP_LEVELS 0u
#endif
vec3 tangent_right = vec3(0.0), tangent_below = vec3(0.0);

vec4 looked_up(sampler2D table, vec2 at, vec2 right, vec2 below) {
  return MIP_LEVELS == 0u ? texture(table, at) : textureGrad(table, at, 0.5 * (right - at), 0.5 * (below - at));
}
vec2 m_coordinate(Angles a) {
  vec2 sines = vec2(a.sin_i, a.sin_o);
  return (over_angles == 0u ? sines : asin(clamp(sines, -1.0, 1.0))) * m_scale_bias.xy + m_scale_bias.zw;
}
vec2 n_value(Angles a, float cos_d) {
  vec2 cosines = vec2(a.cos_phi, cos_d);
  return over_angles == 0u ? cosines : acos(clamp(cosines, -1.0, 1.0));
}
vec2 n_coordinate(Angles a, float cos_d) { return n_value(a, cos_d) * n_scale_bias.xy + n_scale_bias.zw; }

// cos theta_d without the table: of the next pixels, which have no lookup of their own, and over angles.
float cos_half_difference(Angles a) {
  float cosines = sqrt(max((1.0 - a.sin_i * a.sin_i) * (1.0 - a.sin_o * a.sin_o), 0.0));
  return sqrt(max(0.5 * (1.0 + cosines + a.sin_i * a.sin_o), 0.0));
}
vec2 n_step(Angles here, Angles there) {
  return (n_value(there, cos_half_difference(there)) - n_value(here, cos_half_difference(here))) * n_scale_bias.xy;
}

vec3 scattering(Angles here, Angles right, Angles below) {
  vec4 m = looked_up(table_m, m_coordinate(here), m_coordinate(right), m_coordinate(below)) * m_scale;
  vec2 n = n_coordinate(here, over_angles == 0u ? m.a : cos_half_difference(here)), n_right = n, n_below = n;
  if (MIP_LEVELS != 0u) {
    n_right += n_step(here, right);
    n_below += n_step(here, below);
  }
  vec4 n_tt_r = looked_up(table_n_tt_r, n, n_right, n_below) * n_tt_r_scale;
  vec3 n_trt = looked_up(table_n_trt, n, n_right, n_below).rgb * n_trt_scale.rgb;
  return m.r * n_tt_r.aaa + m.g * n_tt_r.rgb + m.b * n_trt;
}
vec3 scattering_of(Angles here, vec3 to_light, vec3 t, vec3 to_eye) {
#ifdef EVALUATED
  if (EVALUATED) return evaluated;  // of this light and vertex, by the model's formulas
#endif
  if (MIP_LEVELS == 0u) return scattering(here, here, here);
  return scattering(here, angles_of(to_light, normalize(t + tangent_right), to_eye),
                    angles_of(to_light, normalize(t + tangent_below), to_eye));
}

// Radiance by a light of which the share `through` of each channel arrives.
vec3 shade(Arriving light, vec3 through, vec3 t, vec3 to_eye) {
  Angles angles = angles_of(light.to_light, t, to_eye);
  float cos_i = sqrt(max(1.0 - angles.sin_i * angles.sin_i, 0.0));
  vec3 once = scattering_of(angles, light.to_light, t, to_eye) * through;
  return (once + multiple.rgb * ambient_share(cos_i, through)) * light.irradiance;
}

// The same of light that this fibre alone has scattered.
vec3 shade_once(Arriving light, vec3 through, vec3 t, vec3 to_eye) {
  Angles angles = angles_of(light.to_light, t, to_eye);
  return scattering_of(angles, light.to_light, t, to_eye) * through * light.irradiance;
}
