// S of a light at a vertex by the model's formulas, in place of tables where k_direct is 1 (direct_gpu.h). Before this
// stand vertex_count and SCATTERED_BINDING.
layout(std430, set = 0, binding = SCATTERED_BINDING) readonly buffer Scattered { float scattered[]; };

vec3 scattered_at(uint light, uint vertex) {
  const uint first = 3u * (light * vertex_count + vertex);
  return vec3(scattered[first], scattered[first + 1u], scattered[first + 2u]);
}
