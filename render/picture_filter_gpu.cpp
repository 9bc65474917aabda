#include "render/picture_filter_gpu.h"

#include <cmath>

#include "gpu/groups.h"
#include "render/passes/pixel_depth/pixel_depth_gpu.h"

namespace cuticle::render {

Result<PictureFilter> PictureFilter::create(gpu::Device& device, std::span<const std::uint32_t> spirv,
                                            glm::ivec2 resolution, std::uint32_t push_constant_bytes,
                                            std::uint32_t own_buffers) {
  gpu::ShaderInterface interface;
  interface.storage_buffers = 2 + own_buffers;
  interface.textures = 1;
  interface.push_constant_bytes = push_constant_bytes;
  PictureFilter filter;
  CUTICLE_ASSIGN(filter.kernel_, device.make_kernel(spirv, interface));
  const std::size_t pixels = std::size_t(resolution.x) * std::size_t(resolution.y);
  CUTICLE_ASSIGN(filter.picture_, device.make_buffer(pixels * sizeof(glm::vec4)));
  return filter;
}

void PictureFilter::record(gpu::Commands& commands, const Resources& resources,
                           std::span<const std::byte> push_constants,
                           std::span<const gpu::Buffer* const> own_buffers) const {
  std::vector<const gpu::Buffer*> buffers{resources.get<pixel_depth::PixelDepth>().values, &picture_};
  buffers.insert(buffers.end(), own_buffers.begin(), own_buffers.end());
  const gpu::Groups groups = gpu::groups_for(picture_.size() / sizeof(glm::vec4));
  const gpu::Texture* const output = resources.get<Output>().picture;
  commands.dispatch(kernel_, buffers, std::span(&output, 1), push_constants, groups.x, groups.y);
  commands.copy(picture_, *output);
}

double pixels_per_slope(const Camera& camera) {
  return camera.resolution.y / (2 * std::tan(camera.vertical_field_of_view / 2));
}

}  // namespace cuticle::render
