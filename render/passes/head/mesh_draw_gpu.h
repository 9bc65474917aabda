#pragma once
// A mesh of the scene with wrapped diffuse light: what the passes "head", "fins" and "floor" draw.
#include "render/pass_gpu.h"

namespace cuticle::render::head {

/// Albedo where a vertex's position has w = 0 and where it has 1, and how light arrives: see head.frag.
struct Diffuse {
  glm::dvec3 albedo_0{0}, albedo_1{0};
  double wrap = 0, ambient = 0;
  double through = 0;  ///< share of the light that comes through a thin sheet
  double bleed = 0;    ///< red light is carried so much farther past the terminator, and blue less far
};

class MeshDraw {
 public:
  /// `fragment`: SPIR-V of head.frag; `one_sided`: triangles that turn clockwise are not drawn. Error: out_of_memory.
  static Result<MeshDraw> create(gpu::Device& device, const Resources& resources,
                                 std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::span<const std::uint32_t> fragment, bool one_sided = false);
  /// positions, normals: vec4 per vertex (w: see Diffuse), moved to the world by `to_world`, a rigid transform.
  Result<void> record(gpu::Device& device, gpu::Commands& commands, const Resources& resources,
                      const gpu::Buffer& positions, const gpu::Buffer& normals, const glm::dmat4& to_world,
                      const Diffuse& diffuse);

 private:
  gpu::GraphicsPipeline pipeline_;
  gpu::Buffer indices_, frame_;
  gpu::Buffer no_hair_;  ///< bound where no hair casts
  gpu::Texture no_map_;  ///< where nothing casts
  std::uint32_t index_count_ = 0;
};

}  // namespace cuticle::render::head
