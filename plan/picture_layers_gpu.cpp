#include "plan/picture_layers_gpu.h"

#include <algorithm>

namespace cuticle::plan {

Result<Image> with_channels(gpu::Device& device, const Image& image, const gpu::Buffer& buffer,
                            std::span<const std::string_view> more_names) {
  std::vector<std::string> names = image.channel_names;
  const std::size_t own = names.size(), more = more_names.size();
  names.insert(names.end(), more_names.begin(), more_names.end());
  Image wider = make_image(image.width, image.height, std::move(names));
  const std::size_t pixels = image.pixels.size() / own;
  CUTICLE_ASSIGN(const auto values, gpu::read_buffer<float>(device, buffer, pixels * more));
  for (std::size_t p = 0; p < pixels; ++p) {
    float* const out = wider.pixels.data() + p * (own + more);
    std::copy_n(image.pixels.data() + p * own, own, out);
    std::copy_n(values.data() + p * more, more, out + own);
  }
  return wider;
}

}  // namespace cuticle::plan
