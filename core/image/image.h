#pragma once
// Pictures and tables in and out: the only user of OpenImageIO and OpenEXR. Row 0 is the top row.
#include <map>
#include <string>
#include <vector>

#include "core/result.h"

namespace cuticle {

/// A float picture or table, channels interleaved, row 0 on top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channel_names;  ///< one per channel, "R", "G", "B", "A" or layer names "velocity.X"
  std::vector<float> pixels;               ///< width * height * channels
  int channels() const { return int(channel_names.size()); }
  float& at(int x, int y, int c) { return pixels[(std::size_t(y) * width + x) * channels() + c]; }
  float at(int x, int y, int c) const { return pixels[(std::size_t(y) * width + x) * channels() + c]; }
};
/// An image of zeros with channels R, G, B(, A) or the given names.
Image make_image(int width, int height, std::vector<std::string> channel_names);

enum class ExrType { half, single };

/// Scanline ZIP EXR by OpenEXR, with string attributes. Error: bad_input naming the file.
Result<void> write_exr(const std::string& path, const Image& image, ExrType type,
                       const std::map<std::string, std::string>& attributes = {});
Result<Image> read_exr(const std::string& path);
/// String attributes of an EXR header.
Result<std::map<std::string, std::string>> read_exr_attributes(const std::string& path);

/// PNG by OpenImageIO, 8 or 16 bit; values are clamped to [0, 1] and written as they are (no transfer curve).
Result<void> write_png(const std::string& path, const Image& image, int bits = 8);
/// Any picture that OpenImageIO reads, as float.
Result<Image> read_image(const std::string& path);
/// Mip levels of any picture that OpenImageIO reads; 1 where the format has none.
Result<int> mip_levels(const std::string& path);

/// Linear radiance to sRGB display values: exposure (stops), a filmic shoulder above 0.8, sRGB transfer. Alpha kept.
Image tone_map(const Image& linear, double exposure_stops = 0);
/// Pictures of equal size side by side, `columns` to a row; what is left over has the first one's first pixel.
Image contact_sheet(const std::vector<Image>& images, int columns);
/// The value as stored in a half float (round to nearest even), for errors "as stored".
float round_to_half(float value);

}  // namespace cuticle
