// Kernels of one workgroup per tile.
#include "render/passes/tile_lists/tile_push.glsl"

const uint k_stride = 7919u;  // a prime: neighbouring tiles, which cost alike, go to different threads of the device

uint spread(uint group, uint count) { return count % k_stride == 0u ? group : uint((group * k_stride) % count); }

uint tile_of_group() {
  uvec2 grid = tile_grid();
  return spread(gl_WorkGroupID.y * grid.x + gl_WorkGroupID.x, grid.x * grid.y);
}
