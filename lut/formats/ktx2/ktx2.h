#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "core/image/image.h"

namespace cuticle::lut::ktx2 {

/// Level 0 as an RGBA image of halves, from a KTX 2.0 file (Khronos specification: VK_FORMAT_R16G16B16A16_SFLOAT, one
/// face, no supercompression). Sides 1 .. 16384. Error: bad_input with file, field, offset.
Result<Image> parse(std::span<const std::byte> bytes, const std::string& file);

}  // namespace cuticle::lut::ktx2
