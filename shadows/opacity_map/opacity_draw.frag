#version 460
#extension GL_GOOGLE_include_directive : require
// N18: sigma of the segment in this texel, written to the planes behind it; blending adds.
#define MAP_IS_DRAWN
#include "shadows/map_geometry.glsl"
#include "shadows/opacity_map/drawn_deposit.glsl"
#include "shadows/splat.glslh"

layout(location = 0) flat in vec4 one_end;
layout(location = 1) flat in vec4 other_end;
layout(location = 2) flat in uvec2 is_tip;
layout(location = 0) out vec4 planes_1_to_4;
layout(location = 1) out vec4 planes_5_to_8;
layout(location = 2) out vec4 planes_9_to_12;
layout(location = 3) out vec4 planes_13_to_16;

/// Each piece of a steep segment counts at its own depth, as the splat by compute has it.
void main() {
  const vec3 a = one_end.xyz, b = other_end.xyz;
  const float half_width = one_end.w;
  const float size = segment_footprint(a, b, half_width, 0.0, 0.0).size;
  const uint pieces = piece_count(a.z * push.pieces_per_step, b.z * push.pieces_per_step, size);
  planes_1_to_4 = planes_5_to_8 = planes_9_to_12 = planes_13_to_16 = vec4(0);
  for (uint i = 0u; i < pieces; ++i) {
    const Footprint footprint = segment_footprint(piece_point(a, b, i, pieces), piece_point(a, b, i + 1u, pieces),
                                                  half_width, is_tip.x != 0u && i == 0u ? 1.0 : 0.0,
                                                  is_tip.y != 0u && i + 1u == pieces ? 1.0 : 0.0);
    const vec2 offset = texel_offset(footprint.from, int(gl_FragCoord.x), int(gl_FragCoord.y));
    const float sigma = sigma_of(coverage_index(coverage(footprint, offset)));
    const int depth_step = max(0, depth_bin(footprint, offset));
    planes_1_to_4 += behind(depth_step, 1, sigma);
    planes_5_to_8 += behind(depth_step, 5, sigma);
    planes_9_to_12 += behind(depth_step, 9, sigma);
    planes_13_to_16 += behind(depth_step, 13, sigma);
  }
}
