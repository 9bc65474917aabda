// The four targets of a drawn map, and the exponent of T in them: four 4-vector dot products with tent weights, which
// are the same for all texels. The shader that includes this says, as k_first_target, where they are bound.
#include "shadows/map_filter.glsl"
#include "shadows/opacity_map/drawn_deposit.glsl"
#include "shadows/opacity_map/tent_planes.glsl"

layout(binding = k_first_target) uniform sampler2D planes_1_to_4;
layout(binding = k_first_target + 1) uniform sampler2D planes_5_to_8;
layout(binding = k_first_target + 2) uniform sampler2D planes_9_to_12;
layout(binding = k_first_target + 3) uniform sampler2D planes_13_to_16;

vec4 weights[4];
vec4 own_planes[4];  // what the receiver's own fibre has left in the texel

void own_deposit(uint covered, uint depth_step) {
  const float sigma = sigma_of(covered);
  for (int i = 0; i < 4; ++i) own_planes[i] += behind(int(depth_step), 4 * i + 1, sigma);
}

/// A target of 8 bits may have cut off more than the own fibre.
vec4 without_own(vec4 planes, int i) { return max(planes - own_planes[i], vec4(0)); }

float weighted_exponent(uint texel) {
  const ivec2 at = ivec2(texel % push.resolution, texel / push.resolution);
  own_planes[0] = own_planes[1] = own_planes[2] = own_planes[3] = vec4(0);
  walk_own();
  const float sigma = dot(weights[0], without_own(texelFetch(planes_1_to_4, at, 0), 0)) +
                      dot(weights[1], without_own(texelFetch(planes_5_to_8, at, 0), 1)) +
                      dot(weights[2], without_own(texelFetch(planes_9_to_12, at, 0), 2)) +
                      dot(weights[3], without_own(texelFetch(planes_13_to_16, at, 0), 3));
  return -push.own[0] * sigma;
}
