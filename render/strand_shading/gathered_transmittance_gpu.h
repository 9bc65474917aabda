#pragma once
// The transmittance of all lights in one buffer, as render/strand_shading/transmittance.glsl reads it.
#include "render/pass_gpu.h"

namespace cuticle::render {

class GatheredTransmittance {
 public:
  /// Room for each light and each of `transmittance_of(resources).channels`: a float per drawn vertex.
  static Result<GatheredTransmittance> make(gpu::Device& device, const Resources& resources);
  /// Copies what the shadow methods found, light by light; 1 everywhere where nothing shadows.
  void record(gpu::Commands& commands, const Resources& resources) const;

  const gpu::Buffer& buffer() const { return buffer_; }
  /// As a shader reads it at a binding.
  static gpu::TexelBinding texels(std::uint32_t binding) { return {binding, gpu::TextureFormat::r32f}; }

 private:
  gpu::Buffer buffer_;
};

}  // namespace cuticle::render
