// A point in a light's map, from what its matrix gives, `bias` metres of depth nearer to the light: x, y in texels of the
// texture, z depth. What lies behind a point light is beside its map.
vec3 place_in_light_map(vec4 at, float bias) {
  if (at.w <= 0.0) return vec3(-1e6, -1e6, 0.0);
  const float near = 1.0 / at.w;
  return vec3(at.xy * near, at.z * near - bias * near * near);
}
