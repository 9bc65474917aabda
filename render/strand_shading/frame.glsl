// What a frame tells the line shaders; frame_gpu.h holds the same fields in the same order.
#include "render/lights.glsl"

layout(std430, set = 0, binding = 3) readonly buffer Frame {
  mat4 world_to_clip;
  vec4 eye;
  vec4 table_maps[4];    // texture coordinate = value * xy + zw
  vec4 table_scales[4];  // value = stored * scale
  vec4 multiple;                          // of light scattered many times, per irradiance
  uint light_count, vertex_count, vertices_per_strand;
  float variation, tip_variation;
  uint drawn_segments;                    // of a strand
  uint packed_vertices;                   // 1: strands/packing
  float opacity_of_radius;                // a strand's width over a line's, times depth, per metre; 0: lines are opaque
  vec2 caustic;                           // of an axis from the caustic: eta^2 - 1, gap
  LightRow lights[k_max_lights];
};

#include "render/visibility/segment_ends.glsl"
