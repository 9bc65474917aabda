// Marschner scattering from lookup tables by dot products alone (GPU Gems 2, chapter 23): no trigonometry here.
//   sin theta_i = L.T, sin theta_o = E.T, cos phi from the parts of L and E across the fibre, cos theta_d from table M.
// Radiance = sum over lights of S irradiance transmittance: the projection of the light onto the fibre is part of M
// (docs/conventions.md). Before this stand lines_frame.glsl and the samplers table_m (M_R, M_TT, M_TRT, cos theta_d),
// table_n_tt_r (N_TT rgb, N_R) and table_n_trt (N_TRT rgb).
#include "cuticle/render/passes/lines/angles.glsl"

vec3 scattering(float sin_i, float sin_o, float cos_phi) {
  vec4 m = texture(table_m, vec2(sin_i, sin_o) * m_scale_bias.xy + m_scale_bias.zw) * m_scale;
  vec2 n_coordinate = vec2(cos_phi, m.a) * n_scale_bias.xy + n_scale_bias.zw;
  vec4 n_tt_r = texture(table_n_tt_r, n_coordinate) * n_tt_r_scale;
  vec3 n_trt = texture(table_n_trt, n_coordinate).rgb * n_trt_scale.rgb;
  return m.r * n_tt_r.aaa + m.g * n_tt_r.rgb + m.b * n_trt;
}

// Radiance by a light of which the share `through` of each channel arrives.
vec3 shade(Arriving light, vec3 through, vec3 t, vec3 to_eye) {
  Angles angles = angles_of(light.to_light, t, to_eye);
  float cos_i = sqrt(max(1.0 - angles.sin_i * angles.sin_i, 0.0));
  vec3 once = scattering(angles.sin_i, angles.sin_o, angles.cos_phi) * through;
  vec3 often = multiple.rgb * (0.7 * cos_i * sqrt(through) + 0.3 * through + 0.06);
  return (once + often) * light.irradiance;
}

// The same of light that this fibre alone has scattered.
vec3 shade_once(Arriving light, vec3 through, vec3 t, vec3 to_eye) {
  Angles angles = angles_of(light.to_light, t, to_eye);
  return scattering(angles.sin_i, angles.sin_o, angles.cos_phi) * through * light.irradiance;
}
