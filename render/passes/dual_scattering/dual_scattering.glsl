// Dual scattering (Zinke, Yuksel, Weber and Keyser 2008) from the averages of the fibre, per colour: what other fibres
// have sent on to a point, and what comes back out of those around it. Before this stand
// render/strand_shading/angles.glsl, render/strand_shading/transmittance.glsl and DUAL_BINDING.
#include "bsdf/dual_scattering/scattered_light.glslh"

layout(std430, set = 0, binding = DUAL_BINDING) readonly buffer DualTerms {
  float forward_density;   // factors on the light that was sent on and that came back: the paper's d_f and d_b
  float backward_density;
  float direction_variance;  // of the inclinations of fibres about a point, rad^2
  // k_dual_terms of each of k_dual_rows inclinations, the middles of equal parts of -pi/2 .. pi/2; behind them
  // k_dual_depths and k_dual_angles corrections (onward, back, diffuse) of each channel.
  vec4 dual_terms[];
};

const uint k_dual_rows = 32u, k_dual_terms = 9u, k_dual_depths = 8u, k_dual_angles = 9u;
const uint k_dual_corrections = k_dual_rows * k_dual_terms;
const uint k_forward = 0u, k_backward = 3u, k_multiple = 6u;  // share, mean of theta_i + theta_o, variance of it
const float k_pi = 3.14159265;

vec3 dual_term(uint which, float theta) {
  float at = clamp((theta / k_pi + 0.5) * float(k_dual_rows) - 0.5, 0.0, float(k_dual_rows - 1u));
  uint below = min(uint(at), k_dual_rows - 2u);
  return mix(dual_terms[below * k_dual_terms + which], dual_terms[(below + 1u) * k_dual_terms + which],
             at - float(below)).rgb;
}

vec3 between_corrections(uint first, uint rows, float at) {
  uint below = min(uint(at), rows - 2u);
  return mix(dual_terms[first + below], dual_terms[first + below + 1u], at - float(below)).xyz;
}

// What the terms leave out, by the optical depth before the point and the cosine of the angle between light and eye
// (bsdf/dual_scattering/corrections.h).
vec3 dual_correction(uint channel, float transmittance, float toward) {
  uint first = k_dual_corrections + channel * (k_dual_depths + k_dual_angles);
  float depth = sqrt(log(transmittance) / log(k_min_transmittance)) * float(k_dual_depths - 1u);
  float angle = (0.5 * toward + 0.5) * float(k_dual_angles - 1u);
  return between_corrections(first, k_dual_depths, depth) *
         between_corrections(first + k_dual_depths, k_dual_angles, clamp(angle, 0.0, float(k_dual_angles - 1u)));
}

// Light that a point receives directly comes back from the fibres behind it; that of other fibres, smeared over the half
// of the azimuths about the light and widened, is scattered by the fibre and comes back too.
vec3 dual_scattering(Angles angles, vec3 transmittance) {
  float theta_i = asin(clamp(angles.sin_i, -1.0, 1.0)), theta_o = asin(clamp(angles.sin_o, -1.0, 1.0));
  float theta_d = 0.5 * (theta_o - theta_i), cos_d = cos(theta_d);
  float away = acos(clamp(angles.cos_phi, -1.0, 1.0)) / k_pi;
  float inclined = cos(theta_i) / (k_pi * max(cos_d * cos_d, 1e-3));
  float toward = angles.sin_i * angles.sin_o + cos(theta_i) * cos(theta_o) * angles.cos_phi;
  vec3 path_share = dual_term(k_forward, theta_i), path_variance = dual_term(k_forward + 2u, theta_i), local[9];
  for (uint i = 0u; i < k_dual_terms; ++i) local[i] = dual_term(i, theta_d);
  vec3 result;
  for (uint c = 0u; c < 3u; ++c) {
    FibreAverages fibre = FibreAverages(ScatteringLobe(path_share[c], 0.0, path_variance[c]),
                                        ScatteringLobe(local[0][c], local[1][c], local[2][c]),
                                        ScatteringLobe(local[3][c], local[4][c], local[5][c]),
                                        ScatteringLobe(local[6][c], local[7][c], local[8][c]));
    float arrives = clamp(transmittance[c], k_min_transmittance, 1.0);
    ScatteredLight light = scattered_light(fibre, arrives, theta_i, theta_o, away, direction_variance);
    vec3 correction = dual_correction(c, arrives, toward);
    float back = backward_density * correction.y * (light.back + forward_density * light.onward_back);
    result[c] = inclined * (forward_density * correction.x * light.onward + back) +
                forward_density * correction.z / (4.0 * k_pi);
  }
  return result;
}

// Where the share `past` of the light passes surfaces. What they take away no fibre has scattered: only what hair leaves
// says how many fibres there were.
vec3 dual_scattering(Angles angles, vec3 transmittance, float past) {
  return past <= 0.0 ? vec3(0.0) : past * dual_scattering(angles, min(transmittance / past, vec3(1.0)));
}
