#pragma once
// Which strands a way of drawing has to draw.
#include "render/pass_gpu.h"
#include "render/passes/cull_strands/cull_strands.h"

namespace cuticle::render::cull_strands {

struct SeenStrands {
  gpu::Buffer list;     ///< uint per strand that is drawn, in their order
  gpu::Buffer numbers;  ///< of Commands::draw_counted
};

/// The list, or `unused` in its place where nothing is culled.
const gpu::Buffer& list_of(const Resources& resources, const gpu::Buffer& unused);
/// The constant `k_listed` of listed_strand.glsl.
std::uint32_t is_listed(const Resources& resources);
/// Draws the strands of the list, or so many vertices where nothing is culled.
void draw(gpu::Commands& commands, const Resources& resources, const gpu::GraphicsPipeline& pipeline,
          std::initializer_list<const gpu::Buffer*> buffers, std::initializer_list<const gpu::Texture*> textures,
          std::span<const std::byte> push_constants, std::uint32_t vertices);

}  // namespace cuticle::render::cull_strands
