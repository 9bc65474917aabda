// A strand lit by one light: by the frame's `multiple`, or with dual scattering. Before this stand
// passes/lines/scattering.glsl and what scattered_often.glsl asks for.
#include "render/passes/dual_scattering/scattered_often.glsl"

vec3 lit(Arriving arriving, vec3 through, float past, vec3 t, vec3 to_eye) {
  if (k_dual == 0u) return shade(arriving, through, t, to_eye);
  return shade_once(arriving, through, t, to_eye) + scattered_often(arriving, through, past, t, to_eye);
}
