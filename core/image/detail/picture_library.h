#pragma once
// What the library of pictures offers, which is loaded with the first picture (picture.cpp).
#include <string>

#include "core/image/image.h"

namespace cuticle::detail {

/// Samples as a file holds them, channels interleaved, row 0 on top.
struct Samples {
  int width, height, channels, bits;  ///< bits a sample: 8 or 16, unsigned
  const void* data;
};
/// Each function names the file in its errors.
struct PictureLibrary {
  Result<void> (*write)(const std::string& path, const Samples& samples);
  Result<Image> (*read)(const std::string& path);
  Result<int> (*mip_levels)(const std::string& path);
};

}  // namespace cuticle::detail
