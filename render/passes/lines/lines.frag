#version 460
// A line's pixel: scattering from lookup tables along the interpolated tangent.
#extension GL_GOOGLE_include_directive : require
#include "lines_frame.glsl"

layout(set = 0, binding = 4) uniform sampler2D table_m;       // M_R, M_TT, M_TRT, cos theta_d
layout(set = 0, binding = 5) uniform sampler2D table_n_tt_r;  // N_TT rgb, N_R
layout(set = 0, binding = 6) uniform sampler2D table_n_trt;   // N_TRT rgb
#include "scattering.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 tangent;
layout(location = 2) in vec4 reached[2];
layout(location = 4) flat in float brightness;
layout(location = 0) out vec4 color;

void main() {
  vec3 t = normalize(tangent);
  vec3 to_eye = normalize(eye.xyz - position);
  vec3 sum = vec3(0.0);
  for (uint k = 0u; k < light_count; ++k) {
    float through = clamp(reached[k >> 2][k & 3u], 0.0, 1.0);  // a sample beside the line extrapolates
    sum += shade(arriving_at(position, lights[k]), through, t, to_eye);
  }
  color = vec4(held_by_halves(sum * brightness), 1.0);
}
