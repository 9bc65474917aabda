// Push constants of the culling kernels (Push of cull_strands_gpu.cpp, word for word). Places and widths are in texels
// of the targets.
layout(push_constant) uniform Push {
  mat4 world_to_clip;
  uvec2 size;          // of the targets
  uint strand_count, vertices_per_strand, drawn_segments;
  uint corners;        // vertices that a segment is drawn with
  float width_scale;   // half a width = radius * this / distance
  float least_half_width;
  float near, far;
  uint has_scene;      // 1: the depth target holds what the scene drew
};

const int k_tile = 16;  // texels each way

uvec2 tile_grid() { return (size + uint(k_tile) - 1u) / uint(k_tile); }
