// Inclinations and azimuth of light and eye about a fibre, by dot products alone.
const float k_tiny = 1e-12;  // keeps the cosine of an undefined azimuth (light or eye along the fibre) at 0

struct Angles {
  float sin_i, sin_o, cos_phi;
};

Angles angles_of(vec3 l, vec3 t, vec3 to_eye) {
  float sin_i = dot(l, t), sin_o = dot(to_eye, t);
  vec3 across_i = l - sin_i * t, across_o = to_eye - sin_o * t;
  float cos_phi = dot(across_i, across_o) * inversesqrt(max(dot(across_i, across_i) * dot(across_o, across_o), k_tiny));
  return Angles(sin_i, sin_o, cos_phi);
}
