#pragma once
// A picture filter that first finds, for every tile of the picture, how far pixels reach into it from the tiles around.
#include "render/picture_filter_gpu.h"

namespace cuticle::render {

/// Tiles of 16 pixels a side that cover a picture, the last ones beyond its edge.
glm::uvec2 filter_tiles(glm::ivec2 resolution);

/// Three dispatches, each with the same push constants:
/// - reach, an invocation per tile: 0 what pixels move or blur by (readonly), 1 the farthest of each tile;
/// - spread, an invocation per tile: 0 the farthest of each tile (readonly), 1 the farthest that reaches into it;
/// - pixels: a PictureFilter whose own buffers begin with spread's.
class TiledFilter {
 public:
  struct Shaders {
    std::span<const std::uint32_t> reach, spread, pixels;  ///< spirv
    std::uint32_t push_constant_bytes = 0;
    std::uint32_t tile_bytes = 0;   ///< of what is kept for a tile
    std::uint32_t own_buffers = 0;  ///< of `pixels`, beside spread's
  };
  /// Errors: as Device::make_kernel and make_buffer.
  static Result<TiledFilter> create(gpu::Device& device, const Shaders& shaders, glm::ivec2 resolution);
  /// `source`: what `reach` reads.
  void record(gpu::Commands& commands, const Resources& resources, const gpu::Buffer& source,
              std::span<const std::byte> push_constants, std::span<const gpu::Buffer* const> own_buffers = {}) const;

 private:
  gpu::Kernel reach_kernel_, spread_kernel_;
  PictureFilter pixels_;
  gpu::Buffer reach_, spread_;
};

}  // namespace cuticle::render
