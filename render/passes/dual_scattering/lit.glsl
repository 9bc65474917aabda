// A strand lit by one light: by the frame's `multiple`, or with dual scattering. Before this stand
// render/strand_shading/scattering.glsl and what multiple_scattering.glsl asks for.
#include "render/passes/dual_scattering/multiple_scattering.glsl"

vec3 lit(Arriving arriving, vec3 transmittance, float past, vec3 t, vec3 to_eye) {
  if (k_dual == 0u) return shade(arriving, transmittance, t, to_eye);
  return shade_single_scattering(arriving, transmittance, t, to_eye) + multiple_scattering(arriving, transmittance, past, t, to_eye);
}
