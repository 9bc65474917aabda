#version 460
#extension GL_GOOGLE_include_directive : require
// Diffuse with wrapped light: (wrap + N.L) / (1 + wrap). Light directions come in the head's rest frame.
const uint k_max_lights = 8;
layout(std430, set = 0, binding = 3) readonly buffer Frame {
  vec4 skin, scalp_color;  // w of skin: wrap; w of scalp_color: number of lights
  vec4 ambient;            // radiance factor, rgb
  vec4 to_light[k_max_lights];
  vec4 irradiance[k_max_lights];
  mat4 rest_to_map[k_max_lights];  // of surface_shadow
  uint map_resolution, map_columns;  // 0: no hair casts
  float map_filter;
};
layout(set = 0, binding = 4) uniform sampler2D hair_map;
#include "cuticle/render/passes/surface_shadow/map_lookup.glsl"

layout(location = 0) in vec3 rest_normal;
layout(location = 1) in float scalp;
layout(location = 2) in vec3 rest_position;
layout(location = 0) out vec4 color;

float reached(uint light) {
  if (map_resolution == 0u) return 1.0;
  vec3 at = (rest_to_map[light] * vec4(rest_position, 1.0)).xyz;
  return unshadowed(hair_map, at, light, map_resolution, map_columns, map_filter);
}

void main() {
  vec3 normal = normalize(rest_normal);
  vec3 received = ambient.rgb;
  for (uint k = 0u; k < uint(scalp_color.w); ++k) {
    float wrapped = (skin.w + dot(normal, to_light[k].xyz)) / (1.0 + skin.w);
    if (wrapped > 0.0) received += wrapped * reached(k) * irradiance[k].rgb;
  }
  color = vec4(mix(skin.rgb, scalp_color.rgb, scalp) * received * 0.31830989, 1.0);
}
