#pragma once
// Private to gpu/ (not installed): texture formats, and floats as their texels.
#include "gpu/detail/device_impl.h"

namespace cuticle::gpu {

VkFormat vulkan_format(TextureFormat format);
VkImageAspectFlags aspect_of(TextureFormat format);
/// Floats per texel on the host side: 1 for r32f, r32u and depth32f, else 4.
std::size_t floats_per_texel(TextureFormat format);
std::size_t bytes_per_texel(TextureFormat format);

/// Mip levels, the texture itself included.
std::uint32_t level_count(const TextureDescription& description);
/// Fills the levels below the first, each from the one above it; nothing for a texture without any.
void record_levels(Device::Impl& device, VkCommandBuffer commands, const TextureObject& object);

/// IEEE half, rounded to nearest even; past 65504 becomes infinity, NaN stays NaN.
std::uint16_t half_from_float(float value);
float float_from_half(std::uint16_t half);

/// Texels of the format from floats (rgba8: 0..1 rounded to 1/255) and back. Sizes must agree.
void texels_from_floats(TextureFormat format, std::span<const float> floats, std::span<std::byte> texels);
void floats_from_texels(TextureFormat format, std::span<const std::byte> texels, std::span<float> floats);

}  // namespace cuticle::gpu
