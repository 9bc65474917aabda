// Scattering from lookup tables (GPU Gems 2, chapter 23): sin theta_i = L.T, sin theta_o = E.T, cos phi from the parts of
// L and E across the fibre; arc functions only where the layout is over angles.
// Radiance = sum over lights of S irradiance transmittance: the projection of the light onto the fibre is part of M
// (docs/conventions.md). Before this stands what tables.glsl asks for.
#include "render/strand_shading/ambient.glsl"
#include "render/strand_shading/angles.glsl"
#include "render/strand_shading/tables.glsl"

// Of mip levels: what is added to the tangent one pixel to the right and one below. Set outside of loops, in which
// llvmpipe leaves zeros beside a line.
vec3 tangent_right = vec3(0.0), tangent_below = vec3(0.0);

vec3 scattering_of(Angles here, vec3 to_light, vec3 t, vec3 to_eye) {
#ifdef EVALUATED
  if (EVALUATED) return evaluated;  // of this light and vertex, by the model's formulas
#endif
  Coordinates at = coordinates_of(here);
  if (MIP_LEVELS == 0u) return scattering_by(at, at, at);
  return scattering_by(at, coordinates_of(angles_of(to_light, normalize(t + tangent_right), to_eye)),
                       coordinates_of(angles_of(to_light, normalize(t + tangent_below), to_eye)));
}

// Radiance by a light of which the share `transmittance` of each channel arrives.
vec3 shade(Arriving light, vec3 transmittance, vec3 t, vec3 to_eye) {
  Angles angles = angles_of(light.to_light, t, to_eye);
  float cos_i = sqrt(max(1.0 - angles.sin_i * angles.sin_i, 0.0));
  vec3 once = scattering_of(angles, light.to_light, t, to_eye) * transmittance;
  return (once + multiple.rgb * multiple_scattering_share(cos_i, transmittance)) * light.irradiance;
}

// The same of light that this fibre alone has scattered.
vec3 shade_single_scattering(Arriving light, vec3 transmittance, vec3 t, vec3 to_eye) {
  Angles angles = angles_of(light.to_light, t, to_eye);
  return scattering_of(angles, light.to_light, t, to_eye) * transmittance * light.irradiance;
}
