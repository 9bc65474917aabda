#pragma once
// Which segments each tile of the screen has to draw: buffers that the tile passes share.
#include "render/pass_gpu.h"
#include "render/passes/tile_lists/tile_lists.h"

namespace cuticle::render::tile_lists {

inline constexpr std::uint32_t k_tile = 8;  ///< pixels each way, as in tile_push.glsl

struct TileLists {
  glm::uvec2 grid{0};           ///< tiles
  std::uint32_t capacity = 0;   ///< entries that there is room for
  double kept_share = 1;        ///< of the strands, in the frame being drawn
  gpu::Buffer scene_depth;      ///< float per pixel: 1 / distance of the scene, 0 where there is none
  gpu::Buffer tile_depth;       ///< float per tile: the farthest of its pixels
  gpu::Buffer counts, offsets;  ///< uint per tile; offsets has one more
  gpu::Buffer entries, sorted;  ///< uvec2 per entry: 1 / depth (bits of a float), first vertex of the segment
  gpu::Buffer depth_ranges;     ///< vec2 per tile: greatest and least 1 / depth, of its sorted entries
  gpu::Buffer visible;          ///< a bit per vertex: it belongs to a segment in some tile's list
  gpu::Buffer statistics;       ///< entries wanted, segments that are not finite
};

/// Push constants of the tile kernels; tile_push.glsl holds the same fields.
struct TilePush {
  glm::mat4 world_to_clip;
  glm::uvec2 resolution, part;
  std::uint32_t segment_count, vertices_per_strand, capacity, supersampling;
  float pixel_scale, inverse_near, inverse_far, tip_variation, kept_share, opacity;
  std::uint32_t slices, corner;
};
static_assert(sizeof(TilePush) == 128);

TilePush push_of(const Resources& resources, const TileLists& lists);

/// Parts of a segment that are listed and drawn as one: all where the scene asks for whole segments, else 1.
std::uint32_t listed_parts(const Resources& resources);

/// Invocations that draw a tile: 8, 32 or 64, by the parameter `lanes`. By itself 8 in software, where a subgroup may
/// be so wide, and 64, one a pixel, on a device with subgroups of 32 or more, which would idle otherwise. The pictures
/// are the same (tiles_lanes_gpu_test).
std::uint32_t lanes_of(const gpu::DeviceInfo& device, const PassParameters& parameters);

}  // namespace cuticle::render::tile_lists
