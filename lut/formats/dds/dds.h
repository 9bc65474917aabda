#pragma once
#include <cstddef>
#include <span>
#include <string>

#include <cuticle/core/image/image.h>

namespace cuticle::lut::dds {

/// An RGBA image of halves from a DDS file with the DX10 header (DXGI_FORMAT_R16G16B16A16_FLOAT, one level, no array),
/// as Microsoft's "Programming Guide for DDS" lays it out. Sides 1 .. 16384. Error: bad_input with file, field, offset.
Result<Image> parse(std::span<const std::byte> bytes, const std::string& file);

}  // namespace cuticle::lut::dds
