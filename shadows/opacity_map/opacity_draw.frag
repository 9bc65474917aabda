#version 460
#extension GL_GOOGLE_include_directive : require
// N18: sigma of the segment in this texel, written to the planes behind it; blending adds.
#define MAP_IS_DRAWN
#include "cuticle/shadows/map_geometry.glsl"
#include "cuticle/shadows/splat.glslh"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(location = 0) flat in vec4 axis;
layout(location = 1) flat in vec4 extent;
layout(location = 2) flat in vec2 at_depth;
layout(location = 0) out vec4 planes_1_to_4;
layout(location = 1) out vec4 planes_5_to_8;
layout(location = 2) out vec4 planes_9_to_12;
layout(location = 3) out vec4 planes_13_to_16;

/// sigma where z_hair < z_slice, for four planes: the fragment lies before the end of its depth step.
vec4 behind(int depth_step, int first_plane, float sigma) {
  return sigma * vec4(lessThan(ivec4(depth_step), ivec4(first_plane) + ivec4(0, 1, 2, 3)));
}

void main() {
  const Footprint footprint =
      Footprint(axis.xy, axis.zw, extent.x, extent.y, extent.z, extent.w, at_depth.x, at_depth.y);
  const vec2 offset = texel_offset(footprint.from, int(gl_FragCoord.x), int(gl_FragCoord.y));
  const float sigma =
      -push.per_unit / push.own[0] * float(table[coverage_index(coverage(footprint, offset))]);
  const int depth_step = max(0, depth_bin(footprint, offset));
  planes_1_to_4 = behind(depth_step, 1, sigma);
  planes_5_to_8 = behind(depth_step, 5, sigma);
  planes_9_to_12 = behind(depth_step, 9, sigma);
  planes_13_to_16 = behind(depth_step, 13, sigma);
}
