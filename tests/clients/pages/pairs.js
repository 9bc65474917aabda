// What the pages of all engines share: the work to be done, and what the pictures are lit by.
export async function loadWork() {
  return (await fetch('/work/pairs.json')).json();
}

// Tangent, light and eye of each pair: three texels of a row.
export function pairTexels(pairs) {
  return { width: 3, height: pairs.length, floats: Float32Array.from(pairs.flatMap((pair) => ['tangent', 'light', 'eye'].flatMap((n) => [...pair[n], 0]))) };
}

export const MEASURE = `
  vec3 tangent = texelFetch(pairs, ivec2(0, row), 0).xyz, light = texelFetch(pairs, ivec2(1, row), 0).xyz, eye = texelFetch(pairs, ivec2(2, row), 0).xyz;
  vec4 found = vec4(cuticle_hair_scattering(light, eye, tangent), float(cuticle_verify_probes()));`;

// From the side and above, as the pictures show it.
export const TO_LIGHT = [0.55, 0.55, 0.63], IRRADIANCE = [7.02, 6.57, 5.94], AMBIENT = [0.06, 0.043, 0.025];
// For three.js, whose material has no tone curve.
export const SHADE = `
  float sine = dot(toLight, along);
  vec3 lit = vec3(${AMBIENT}) + irradiance * cuticle_hair_scattering(toLight, normalize(toEye), along) * sqrt(max(1.0 - sine * sine, 0.0));
  vec3 shown = pow(lit / (1.0 + lit), vec3(1.0 / 2.2));`;

// Bounds and number of a position list.
export function bounds(positions) {
  const lower = [Infinity, Infinity, Infinity], upper = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    lower[i % 3] = Math.min(lower[i % 3], positions[i]);
    upper[i % 3] = Math.max(upper[i % 3], positions[i]);
  }
  return { vertices: positions.length / 3, lower, upper };
}
