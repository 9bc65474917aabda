#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "core/image/image.h"

namespace cuticle::lut::dds {

/// Level 0 as an RGBA image of halves, from a DDS file with the DX10 header (DXGI_FORMAT_R16G16B16A16_FLOAT, no array),
/// as Microsoft's "Programming Guide for DDS" lays it out. Sides 1 .. 16384. Error: bad_input with file, field, offset.
Result<Image> parse(std::span<const std::byte> bytes, const std::string& file);

}  // namespace cuticle::lut::dds
