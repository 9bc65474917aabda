#include <algorithm>
#include <cmath>
#include <cstring>

#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

template <class Texel, class Convert>
void to_texels(std::span<const float> floats, std::span<std::byte> texels, const Convert& convert) {
  for (std::size_t i = 0; i < floats.size(); ++i) {
    const Texel texel = convert(floats[i]);
    std::memcpy(texels.data() + i * sizeof texel, &texel, sizeof texel);
  }
}

template <class Texel, class Convert>
void to_floats(std::span<const std::byte> texels, std::span<float> floats, const Convert& convert) {
  for (std::size_t i = 0; i < floats.size(); ++i) {
    Texel texel{};
    std::memcpy(&texel, texels.data() + i * sizeof texel, sizeof texel);
    floats[i] = convert(texel);
  }
}

// NaN becomes 0, as the clamp's comparison fails.
std::uint8_t byte_from_float(float value) {
  return value > 0 ? std::uint8_t(std::lround(std::min(value, 1.0f) * 255)) : 0;
}

}  // namespace

VkFormat vulkan_format(TextureFormat format) {
  switch (format) {
    case TextureFormat::rgba8:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case TextureFormat::rgba16f:
      return VK_FORMAT_R16G16B16A16_SFLOAT;
    case TextureFormat::rgba32f:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case TextureFormat::r32f:
      return VK_FORMAT_R32_SFLOAT;
    case TextureFormat::r32u:
      return VK_FORMAT_R32_UINT;
    case TextureFormat::rgba32u:
      return VK_FORMAT_R32G32B32A32_UINT;
    case TextureFormat::depth32f:
      return VK_FORMAT_D32_SFLOAT;
  }
  return VK_FORMAT_UNDEFINED;
}

VkImageAspectFlags aspect_of(TextureFormat format) {
  return format == TextureFormat::depth32f ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

std::size_t floats_per_texel(TextureFormat format) {
  switch (format) {
    case TextureFormat::r32f:
    case TextureFormat::r32u:
    case TextureFormat::depth32f:
      return 1;
    default:
      return 4;
  }
}

std::size_t bytes_per_texel(TextureFormat format) {
  switch (format) {
    case TextureFormat::rgba16f:
      return 8;
    case TextureFormat::rgba32f:
    case TextureFormat::rgba32u:
      return 16;
    default:
      return 4;
  }
}

void texels_from_floats(TextureFormat format, std::span<const float> floats, std::span<std::byte> texels) {
  switch (format) {
    case TextureFormat::rgba8:
      return to_texels<std::uint8_t>(floats, texels, byte_from_float);
    case TextureFormat::rgba16f:
      return to_texels<std::uint16_t>(floats, texels, half_from_float);
    case TextureFormat::r32u:
    case TextureFormat::rgba32u:
      return to_texels<std::uint32_t>(floats, texels, [](float value) { return std::uint32_t(value); });
    default:
      std::memcpy(texels.data(), floats.data(), floats.size_bytes());
  }
}

void floats_from_texels(TextureFormat format, std::span<const std::byte> texels, std::span<float> floats) {
  switch (format) {
    case TextureFormat::rgba8:
      return to_floats<std::uint8_t>(texels, floats, [](std::uint8_t value) { return float(value) / 255; });
    case TextureFormat::rgba16f:
      return to_floats<std::uint16_t>(texels, floats, float_from_half);
    case TextureFormat::r32u:
    case TextureFormat::rgba32u:
      return to_floats<std::uint32_t>(texels, floats, [](std::uint32_t value) { return float(value); });
    default:
      std::memcpy(floats.data(), texels.data(), floats.size_bytes());
  }
}

}  // namespace cuticle::gpu
