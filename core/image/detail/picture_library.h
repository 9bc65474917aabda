#pragma once
// What the library of pictures offers, which is loaded with the first picture (picture.cpp).
#include <cstdint>
#include <string>

#include "core/image/image.h"

namespace cuticle::detail {

/// Samples as a file holds them, channels interleaved, row 0 on top.
struct Samples {
  int width, height, channels, bits;  ///< bits a sample: 8 or 16, unsigned
  const void* data;
};
/// Of a picture, as its file states it.
struct PictureSize {
  std::int64_t width, height, depth, channels;
};
/// Error: bad_input where a file of its length cannot hold so much, where floats of it would pass memory_limit(), and
/// for pictures of several layers in depth. Before anything is allocated.
Result<void> check_picture(const std::string& path, const PictureSize& size);

/// Each function names the file in its errors.
struct PictureLibrary {
  Result<void> (*write)(const std::string& path, const Samples& samples);
  /// `check`: check_picture, whose limit is the program's.
  Result<Image> (*read)(const std::string& path, Result<void> (*check)(const std::string& path, const PictureSize& size));
  Result<int> (*mip_levels)(const std::string& path);
};

}  // namespace cuticle::detail
