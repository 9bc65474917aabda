// The four targets of a drawn map, and the exponent of T in them: four 4-vector dot products with tent weights, which
// are the same for all texels. The shader that includes this binds three buffers before.
#include "shadows/map_filter.glsl"
#include "shadows/opacity_map/tent_planes.glsl"

layout(binding = 3) uniform sampler2D planes_1_to_4;
layout(binding = 4) uniform sampler2D planes_5_to_8;
layout(binding = 5) uniform sampler2D planes_9_to_12;
layout(binding = 6) uniform sampler2D planes_13_to_16;

vec4 weights[4];

float weighted_exponent(uint texel) {
  const ivec2 at = ivec2(texel % push.resolution, texel / push.resolution);
  const float sigma =
      dot(weights[0], texelFetch(planes_1_to_4, at, 0)) + dot(weights[1], texelFetch(planes_5_to_8, at, 0)) +
      dot(weights[2], texelFetch(planes_9_to_12, at, 0)) + dot(weights[3], texelFetch(planes_13_to_16, at, 0));
  return -push.own[0] * sigma;
}
