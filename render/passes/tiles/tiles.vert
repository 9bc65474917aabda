#version 460
// Two triangles for each run of tiles side by side of which one has segments: the rest of the picture has no hair to be
// merged. Six vertices a run, all at one place where it has none.
layout(std430, set = 0, binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(push_constant) uniform Push {
  uvec2 part;  // pixels that are drawn
  float per_sample, inverse_near, inverse_far;
};

const uint k_tile = 8u, k_run = 8u;  // pixels of a tile; tiles of a run (k_merged_run of tiles_gpu.cpp)

void main() {
  uvec2 grid = (part + k_tile - 1u) / k_tile;
  uint runs = (grid.x + k_run - 1u) / k_run, run = uint(gl_VertexIndex) / 6u, corner = uint(gl_VertexIndex) % 6u;
  uvec2 first = uvec2(run % runs * k_run, run / runs), end = uvec2(min(first.x + k_run, grid.x), first.y + 1u);
  bool is_empty = offsets[first.y * grid.x + first.x] == offsets[first.y * grid.x + end.x];
  bvec2 is_far = bvec2(corner == 1u || corner == 2u || corner == 4u, corner == 2u || corner == 4u || corner == 5u);
  uvec2 tile = is_empty ? first : uvec2(is_far.x ? end.x : first.x, is_far.y ? end.y : first.y);
  gl_Position = vec4(2.0 * vec2(min(tile * k_tile, part)) / vec2(part) - 1.0, 0.0, 1.0);
}
