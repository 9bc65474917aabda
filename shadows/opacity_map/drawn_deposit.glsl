// What a deposit adds to the planes of a drawn map; needs map_geometry.glsl.
layout(std430, binding = 3) readonly buffer Table { uint table[]; };

/// sigma where z_hair < z_slice, for four planes: the fragment lies before the end of its depth step.
vec4 behind(int depth_step, int first_plane, float sigma) {
  return sigma * vec4(lessThan(ivec4(depth_step), ivec4(first_plane) + ivec4(0, 1, 2, 3)));
}

/// sigma of a deposit; rounded as a target of 8 bits does.
float sigma_of(uint covered) {
  const float sigma = -push.per_unit / push.own[0] * float(table[covered]);
  return (push.flags & k_byte_target) != 0u ? floor(255.0 * sigma + 0.5) / 255.0 : sigma;
}
