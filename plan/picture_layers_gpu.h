#pragma once
// Layers of a picture, from the device.
#include <span>
#include <string_view>

#include "core/image/image.h"
#include "gpu/device.h"

namespace cuticle::plan {

/// A picture's channels, then floats of a buffer, as many a pixel as there are names.
Result<Image> with_channels(gpu::Device& device, const Image& image, const gpu::Buffer& buffer,
                            std::span<const std::string_view> more_names);

}  // namespace cuticle::plan
