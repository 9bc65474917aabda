#pragma once
// A pass that replaces the finished picture by one made from it and from how far away each pixel is.
#include "render/pass_gpu.h"

namespace cuticle::render {

/// One dispatch over the pixels, then a copy into the frame's output. The kernel's bindings: 0 1 / distance of each
/// pixel (readonly), 1 the new picture, vec4 a pixel (writeonly), then buffers of the pass, then the picture as
/// sampler.
class PictureFilter {
 public:
  /// `own_buffers`: how many the pass adds. Errors: as Device::make_kernel and make_buffer.
  static Result<PictureFilter> create(gpu::Device& device, std::span<const std::uint32_t> spirv, glm::ivec2 resolution,
                                      std::uint32_t push_constant_bytes, std::uint32_t own_buffers = 0);
  void record(gpu::Commands& commands, const Resources& resources, std::span<const std::byte> push_constants,
              std::span<const gpu::Buffer* const> own_buffers = {}) const;

  /// The new picture, vec4 a pixel, until the next frame.
  const gpu::Buffer& picture() const { return picture_; }

 private:
  gpu::Kernel kernel_;
  gpu::Buffer picture_;
};

/// Pixels that a length of 1 at distance 1 takes on the screen.
double pixels_per_slope(const Camera& camera);

}  // namespace cuticle::render
