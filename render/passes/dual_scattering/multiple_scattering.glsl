// Light that other fibres have scattered, for any shader that lights strands. Before this stand
// render/strand_shading/transmittance.glsl, render/strand_shading/angles.glsl, DUAL_CONSTANT, the number of the first of
// two specialisation constants, and DUAL_BINDING, that of the first of two buffers (dual_scattering_gpu.h).
layout(constant_id = DUAL_CONSTANT) const uint k_dual = 0u;  // 1: dual scattering in place of the frame's `multiple`
layout(constant_id = DUAL_CONSTANT + 1) const uint k_surfaces = 0u;  // 1: surfaces cast too
layout(std430, set = 0, binding = DUAL_BINDING + 1) readonly buffer Visibility { float visibility[]; };
#include "render/passes/dual_scattering/dual_scattering.glsl"

// What of a light passes the surfaces to a vertex.
float past_surfaces(uint light, uint vertex) {
  return k_dual == 0u || k_surfaces == 0u ? 1.0 : visibility[light * vertex_count + vertex];
}

vec3 multiple_scattering(Arriving arriving, vec3 transmittance, float past, vec3 t, vec3 to_eye) {
  return dual_scattering(angles_of(arriving.to_light, t, to_eye), transmittance, past) * arriving.irradiance;
}
