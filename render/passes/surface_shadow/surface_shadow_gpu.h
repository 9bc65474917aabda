#pragma once
// Depth as each light sees it, the lights' maps side by side in one texture.
#include <array>

#include "render/pass_gpu.h"
#include "render/passes/surface_shadow/surface_shadow.h"

namespace cuticle::render::surface_shadow {

/// As surface_maps.glsl has it.
struct MapsFrame {
  std::array<glm::mat4, k_max_lights> world_to_map;  ///< x, y in texels of the texture, z depth 0 .. 1, over w
  std::array<glm::vec4, k_max_lights> sight;         ///< xyz + w * point: away from the light, of any length
  std::array<float, k_max_lights> bias;              ///< of depth, over w^2
  glm::vec2 texture_size;
  std::uint32_t resolution, columns;
};

/// What other passes read of the maps.
struct Maps {
  MapsFrame frame{};
  gpu::Texture surfaces;     ///< depth32f
  gpu::Buffer hair;          ///< the same as words, row by row; for each opacity of different_channels below the last
  gpu::Buffer visibility;    ///< of each light past the surfaces: one float per vertex, light by light
  float surface_filter = 3;  ///< texels
};

}  // namespace cuticle::render::surface_shadow
