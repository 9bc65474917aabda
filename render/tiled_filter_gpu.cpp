#include "render/tiled_filter_gpu.h"

#include "gpu/groups.h"

namespace cuticle::render {

namespace {

constexpr std::uint32_t k_tile = 16;  // as filter_tile.glsl

}  // namespace

glm::uvec2 filter_tiles(glm::ivec2 resolution) { return (glm::uvec2(resolution) + k_tile - 1u) / k_tile; }

Result<TiledFilter> TiledFilter::create(gpu::Device& device, const Shaders& shaders, glm::ivec2 resolution) {
  const gpu::ShaderInterface interface { 2, 0, shaders.push_constant_bytes };
  const glm::uvec2 tiles = filter_tiles(resolution);
  const std::size_t bytes = std::size_t(tiles.x) * tiles.y * shaders.tile_bytes;
  TiledFilter filter;
  CUTICLE_ASSIGN(filter.reach_kernel_, device.make_kernel(shaders.reach, interface));
  CUTICLE_ASSIGN(filter.spread_kernel_, device.make_kernel(shaders.spread, interface));
  CUTICLE_ASSIGN(filter.pixels_, PictureFilter::create(device, shaders.pixels, resolution, shaders.push_constant_bytes,
                                                       shaders.own_buffers + 1));
  CUTICLE_ASSIGN(filter.reach_, device.make_buffer(bytes));
  CUTICLE_ASSIGN(filter.spread_, device.make_buffer(bytes));
  return filter;
}

void TiledFilter::record(gpu::Commands& commands, const Resources& resources, const gpu::Buffer& source,
                         std::span<const std::byte> push_constants,
                         std::span<const gpu::Buffer* const> own_buffers) const {
  const glm::uvec2 tiles = filter_tiles(resources.get<FrameView>().camera.resolution);
  const gpu::Groups groups = gpu::groups_for(std::size_t(tiles.x) * tiles.y);
  commands.dispatch(reach_kernel_, {&source, &reach_}, {}, push_constants, groups.x, groups.y);
  commands.dispatch(spread_kernel_, {&reach_, &spread_}, {}, push_constants, groups.x, groups.y);
  std::vector<const gpu::Buffer*> own{&spread_};
  own.insert(own.end(), own_buffers.begin(), own_buffers.end());
  pixels_.record(commands, resources, push_constants, own);
}

}  // namespace cuticle::render
