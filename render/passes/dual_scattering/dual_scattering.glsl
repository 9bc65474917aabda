// Dual scattering (Zinke, Yuksel, Weber and Keyser 2008) from the averages of the fibre, per colour: what other fibres
// have sent on to a point, and what comes back out of those around it. Before this stand
// passes/lines/angles.glsl, passes/lines/transmittance.glsl and DUAL_BINDING.
layout(std430, set = 0, binding = DUAL_BINDING) readonly buffer DualTerms {
  float forward_density;   // the paper's d_f
  float backward_density;  // its d_b
  float direction_variance;  // of the inclinations of fibres about a point, rad^2
  vec4 dual_terms[];  // k_dual_terms of each of k_dual_rows inclinations, the middles of equal parts of -pi/2 .. pi/2
};

const uint k_dual_rows = 32u, k_dual_terms = 9u;
const uint k_forward = 0u, k_backward = 3u, k_multiple = 6u;  // share, mean of theta_i + theta_o, variance of it
const float k_pi = 3.14159265, k_least_scattered = 1e-5, k_least_through = 1e-6;

vec3 dual_term(uint which, float theta) {
  float at = clamp((theta / k_pi + 0.5) * float(k_dual_rows) - 0.5, 0.0, float(k_dual_rows - 1u));
  uint below = min(uint(at), k_dual_rows - 2u);
  return mix(dual_terms[below * k_dual_terms + which], dual_terms[(below + 1u) * k_dual_terms + which],
             at - float(below)).rgb;
}

// Share times a Gaussian of theta_i + theta_o, wider by a variance.
vec3 dual_lobe(uint lobe, float theta, float sum, vec3 wider) {
  vec3 off = sum - dual_term(lobe + 1u, theta), variance = max(dual_term(lobe + 2u, theta) + wider, 1e-6);
  return dual_term(lobe, theta) * exp(-0.5 * off * off / variance) * inversesqrt(2.0 * k_pi * variance);
}

// What is sent on, scattered forward at least once, where the share `through` of the light meets no fibre. Fibres are
// met at random (Poisson), ln(1 / through) times in the mean, and each meeting sends the share a_f on, so that
// through^(1 - a_f) arrives in all. `events`: the mean number of scatterings of that light.
vec3 sent_on(vec3 through, vec3 share, out vec3 events) {
  vec3 arrives = clamp(through, k_least_through, 1.0), meetings = -log(arrives) * share;
  vec3 scattered = arrives * (exp(meetings) - 1.0);
  events = max(meetings / max(1.0 - exp(-meetings), k_least_scattered), 1.0);
  return scattered;
}

// Light that a point receives directly comes back from the fibres behind it; that of other fibres, smeared over the half
// of the azimuths about the light and widened, is scattered by the fibre and comes back too. Within each half azimuths
// count evenly, so that `away`, the share of the smeared light that lies behind the fibre as the eye sees it, is
// phi / pi.
vec3 dual_scattering(Angles angles, vec3 through) {
  float theta_i = asin(clamp(angles.sin_i, -1.0, 1.0)), theta_o = asin(clamp(angles.sin_o, -1.0, 1.0));
  float theta_d = 0.5 * (theta_o - theta_i), sum = theta_i + theta_o;
  float away = acos(clamp(angles.cos_phi, -1.0, 1.0)) / k_pi, toward = 1.0 - away;
  vec3 events, scattered = sent_on(through, dual_term(k_forward, theta_i), events);
  vec3 bent = vec3(direction_variance), spread = events * (dual_term(k_forward + 2u, theta_i) + bent);
  vec3 once = away * dual_lobe(k_forward, theta_d, sum, spread) + toward * dual_lobe(k_backward, theta_d, sum, spread);
  vec3 back = backward_density * toward * dual_lobe(k_multiple, theta_d, sum, bent);
  vec3 back_spread = backward_density * toward * dual_lobe(k_multiple, theta_d, sum, spread + bent);
  float cos_d = cos(theta_d), inclined = cos(theta_i) / (k_pi * max(cos_d * cos_d, 1e-3));
  return inclined * (through * back + forward_density * scattered * (once + back_spread));
}

// Where the share `past` of the light passes surfaces. What they take away no fibre has scattered: only what hair leaves
// says how many fibres there were.
vec3 dual_scattering(Angles angles, vec3 through, float past) {
  return past <= 0.0 ? vec3(0.0) : past * dual_scattering(angles, min(through / past, vec3(1.0)));
}
