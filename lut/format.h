#pragma once
// File formats of tables: a folder of lut/formats each, found by CMake.
#include <span>
#include <string>
#include <string_view>

#include "core/image/image.h"

namespace cuticle::lut {

/// How a file holds a table's numbers. Stored numbers are what a shader reads from the texture; value = stored * scale.
struct Format {
  std::string_view name;       ///< as --format takes it, "exr"
  std::string_view extension;  ///< of its files, without the dot
  std::string_view summary;    ///< "OpenEXR, half, ZIP"
  double largest;              ///< the largest number it stores
  bool scaled_to_peak;  ///< a channel's largest value is stored as `largest`; else values are scaled only beyond it
  double filter_step;   ///< of `largest`: a device may filter whole numbers in steps of their own; else 0
  double (*round)(double stored);  ///< the nearest number that it stores, for 0 .. largest
  /// Channels R, G, B or R, G, B, A, row 0 = v 0; `manifest` goes in where the format has a place for text.
  Result<void> (*write)(const std::string& path, const Image& image, const std::string& manifest);
  /// Stored numbers, row 0 = v 0, at least the channels written. Error: bad_input with file, field and offset.
  Result<Image> (*read)(const std::string& path);
  /// Mip levels in the file. Error: bad_input naming the file.
  Result<int> (*levels)(const std::string& path);
  int bytes = 2;  ///< of a number in the texture
};
std::span<const Format* const> formats();
/// The format of that name. Error: usage, listing them.
Result<const Format*> find_format(std::string_view name);
/// The format "exr", the default.
const Format& half_exr();

}  // namespace cuticle::lut
