#include "core/image/image.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <Imath/half.h>
#include <fmt/core.h>

#include "core/image/detail/picture_library.h"
#include "core/memory_limit.h"

namespace cuticle {

Image make_image(int width, int height, std::vector<std::string> channel_names) {
  CUTICLE_EXPECT(width >= 0 && height >= 0, "an image has a size");
  Image image;
  image.width = width;
  image.height = height;
  image.channel_names = std::move(channel_names);
  image.pixels.assign(std::size_t(width) * std::size_t(height) * image.channel_names.size(), 0.0f);
  return image;
}

namespace detail {

Result<void> check_picture(const std::string& path, const PictureSize& size) {
  // A picture of one colour takes a bit a pixel before deflate shrinks it by 1032, and 32 bits a channel after.
  constexpr std::uint64_t most_unfolding = 1 << 16, least_bytes = 1 << 16;
  const std::string words = fmt::format("{}: a picture of {} x {} x {} pixels and {} channels", path, size.width,
                                        size.height, size.depth, size.channels);
  if (size.width < 1 || size.height < 1 || size.depth != 1 || size.channels < 1 || size.channels > 1024)
    return bad_input(fmt::format("{}; allowed: 1 or more x 1 or more x 1, 1 .. 1024 channels", words));
  std::error_code failed;
  const std::uint64_t length = std::filesystem::file_size(path, failed);
  const std::uint64_t factors[] = {std::uint64_t(size.width), std::uint64_t(size.height), std::uint64_t(size.channels),
                                   sizeof(float)};
  if (!failed && !product_within(length * most_unfolding + least_bytes, factors))
    return bad_input(fmt::format("{} cannot be what {} bytes hold", words, length), "check that the file is whole");
  return require_memory(words, {factors[0], factors[1], factors[2], factors[3]});
}

}  // namespace detail

float round_to_half(float value) { return float(Imath::half(value)); }

namespace {

/// Linear up to 0.8, then a shoulder with slope 1 at its foot that reaches 1 at infinity.
float filmic_shoulder(float linear) {
  constexpr float foot = 0.8f;
  if (linear <= foot) return linear;
  const float over = (linear - foot) / (1.0f - foot);
  return foot + (1.0f - foot) * (over / (1.0f + over));
}

/// IEC 61966-2-1.
float srgb_transfer(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// Of one channel. Curved by itself a bright colour turns white, scaled with the brightest channel it stays as it is:
/// between the two, so that hair in strong light keeps its colour and still looks bright.
float display_value(float radiance, float peak) {
  constexpr float k_whitens = 0.3f;
  if (!(radiance > 0.0f)) return 0.0f;
  const float kept = filmic_shoulder(peak) * (radiance / peak), own = filmic_shoulder(radiance);
  return std::min(srgb_transfer(kept + k_whitens * (own - kept)), 1.0f);
}

void paste(const Image& from, Image& sheet, int left, int top) {
  const int channels = std::min(from.channels(), sheet.channels());
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x)
      for (int c = 0; c < channels; ++c) sheet.at(left + x, top + y, c) = from.at(x, y, c);
}

}  // namespace

Image tone_map(const Image& linear, double exposure_stops) {
  Image display = linear;
  const float gain = float(std::exp2(exposure_stops));
  const std::size_t channels = std::size_t(linear.channels());
  const auto exposed = [&](std::size_t i) { return std::min(linear.pixels[i] * gain, 1e30f); };
  for (std::size_t first = 0; first < display.pixels.size(); first += channels) {
    float peak = 0;
    for (std::size_t c = 0; c < channels; ++c)
      if (linear.channel_names[c] != "A") peak = std::max(peak, exposed(first + c));
    for (std::size_t c = 0; c < channels; ++c)
      if (linear.channel_names[c] != "A") display.pixels[first + c] = display_value(exposed(first + c), peak);
  }
  return display;
}

Image contact_sheet(const std::vector<Image>& images, int columns) {
  if (images.empty()) return {};
  columns = std::clamp(columns, 1, int(images.size()));
  const int rows = (int(images.size()) + columns - 1) / columns;
  const Image& first = images.front();
  Image sheet = make_image(first.width * columns, first.height * rows, first.channel_names);
  const std::size_t channels = std::size_t(first.channels());
  for (std::size_t i = 0; i < sheet.pixels.size(); ++i) sheet.pixels[i] = first.pixels[i % channels];
  for (int i = 0; i < int(images.size()); ++i) {
    CUTICLE_EXPECT(images[i].width == first.width && images[i].height == first.height,
                   "pictures of a sheet have equal sizes");
    paste(images[i], sheet, (i % columns) * first.width, (i / columns) * first.height);
  }
  return sheet;
}

}  // namespace cuticle
