#pragma once
// What the formats of 16-bit floats share: their range and rounding, and four of them a texel.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "core/file.h"
#include "core/image/image.h"
#include "lut/formats/bytes.h"

namespace cuticle::lut {

inline constexpr double k_largest_half = 65504;
inline constexpr std::size_t k_bytes_of_half_texel = 8;
inline constexpr std::uint32_t k_largest_side = 16384;  ///< texels each way that readers accept
inline constexpr std::uint32_t k_max_levels = 15;       ///< mip levels of that side

inline double nearest_half(double stored) { return double(round_to_half(float(stored))); }

/// Rows from the top, four halves a texel; a missing channel is 0, a missing alpha 1.
inline void put_half_texels(ByteWriter& out, const Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 4; ++c) {
        const float value = c < image.channels() ? image.at(x, y, c) : c == 3 ? 1.0F : 0.0F;
        out.u16(glm::packHalf1x16(value));
      }
}

/// The texels that `put_half_texels` writes, as an RGBA image.
inline Image half_texels(std::span<const std::byte> bytes, int width, int height) {
  Image image = make_image(width, height, {"R", "G", "B", "A"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = glm::unpackHalf1x16(std::uint16_t(number_at(bytes, 2 * i, 2)));
  return image;
}

/// A format's `read` from the function that parses its bytes.
template <Result<Image> (*parse)(std::span<const std::byte>, const std::string& file)>
Result<Image> read_with(const std::string& path) {
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  return parse(bytes, path);
}

}  // namespace cuticle::lut
