// The lights' maps side by side; surface_shadow_gpu.h holds the same fields. Before this: MAPS_BINDING.
layout(std430, set = 0, binding = MAPS_BINDING) readonly buffer Maps {
  mat4 world_to_map[8];
  vec4 map_forward[8];  // w: depth of the bias
  vec2 map_texture_size;
  uint map_resolution, map_columns;
};

vec4 map_clip(uint light, vec3 world) {
  vec3 at = (world_to_map[light] * vec4(world, 1.0)).xyz;
  return vec4(2.0 * at.xy / map_texture_size - 1.0, at.z, 1.0);
}

// Whether a fragment lies in the map of its light.
bool in_own_map(vec2 place, uint light) {
  return uvec2(place) / map_resolution == uvec2(light % map_columns, light / map_columns);
}
