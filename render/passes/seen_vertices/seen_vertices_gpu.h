#pragma once
// The vertices that show, for the kernels that shade them.
#include "render/pass_gpu.h"
#include "render/passes/seen_vertices/seen_vertices.h"
#include "render/passes/tiles/fine_gpu.h"

namespace cuticle::render::seen_vertices {

struct SeenVertices {
  gpu::Buffer bits;  ///< a bit per vertex
  /// 32-bit words: how many, workgroups of 64 threads over them (three axes), then which, ascending.
  gpu::Buffer list;
  tiles::Records records;  ///< of the segments, without colours, where the fine rasteriser reads them
};
inline constexpr std::size_t k_list_head = 4;      ///< words
inline constexpr std::size_t k_listed_groups = 4;  ///< where Commands::dispatch_counted finds the workgroups, bytes

}  // namespace cuticle::render::seen_vertices
