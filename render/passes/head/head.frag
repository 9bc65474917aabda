#version 460
// Diffuse with wrapped light: (wrap + N.L) / (1 + wrap). Light directions come in the head's rest frame.
const uint k_max_lights = 8;
layout(std430, set = 0, binding = 3) readonly buffer Frame {
  vec4 skin, scalp_color;  // w of skin: wrap; w of scalp_color: number of lights
  vec4 ambient;            // radiance factor, rgb
  vec4 to_light[k_max_lights];
  vec4 irradiance[k_max_lights];
};

layout(location = 0) in vec3 rest_normal;
layout(location = 1) in float scalp;
layout(location = 0) out vec4 color;

void main() {
  vec3 normal = normalize(rest_normal);
  vec3 received = ambient.rgb;
  for (uint k = 0u; k < uint(scalp_color.w); ++k) {
    float wrapped = (skin.w + dot(normal, to_light[k].xyz)) / (1.0 + skin.w);
    received += max(wrapped, 0.0) * irradiance[k].rgb;
  }
  color = vec4(mix(skin.rgb, scalp_color.rgb, scalp) * received * 0.31830989, 1.0);
}
