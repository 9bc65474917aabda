#include "study/picture/shown_picture.h"

#include <algorithm>

namespace cuticle::study {
namespace {

constexpr int k_reach = 3;        ///< pixels to each side
constexpr float k_outshines = 3;  ///< times the median around

float brightness(const Image& image, std::size_t pixel) {
  const float* rgba = image.pixels.data() + 4 * pixel;
  return 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2];
}

/// Covered pixels within reach of one, itself too.
std::vector<std::size_t> around(const Image& image, int x, int y) {
  std::vector<std::size_t> pixels;
  for (int j = std::max(0, y - k_reach); j <= std::min(image.height - 1, y + k_reach); ++j)
    for (int i = std::max(0, x - k_reach); i <= std::min(image.width - 1, x + k_reach); ++i)
      if (image.at(i, j, 3) > 0) pixels.push_back(std::size_t(j) * std::size_t(image.width) + std::size_t(i));
  return pixels;
}

float median_brightness(const Image& image, const std::vector<std::size_t>& pixels) {
  std::vector<float> values;
  for (const std::size_t pixel : pixels) values.push_back(brightness(image, pixel));
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// Of a pixel that outshines those around it, what it has above them goes to them.
void spread(const Image& mean, std::size_t pixel, const std::vector<std::size_t>& pixels, Image& shown) {
  const float most = k_outshines * median_brightness(mean, pixels), bright = brightness(mean, pixel);
  if (bright <= most) return;
  for (std::size_t c = 0; c < 3; ++c) {
    const float above = mean.pixels[4 * pixel + c] * (1 - most / bright);
    shown.pixels[4 * pixel + c] -= above;
    for (const std::size_t other : pixels) shown.pixels[4 * other + c] += above / float(pixels.size());
  }
}

}  // namespace

Image evened(const Image& mean) {
  Image shown = mean;
  for (int y = 0; y < mean.height; ++y)
    for (int x = 0; x < mean.width; ++x)
      if (const auto pixels = around(mean, x, y); mean.at(x, y, 3) > 0)
        spread(mean, std::size_t(y) * std::size_t(mean.width) + std::size_t(x), pixels, shown);
  return shown;
}

Image shown_picture(const NoisyPicture& picture) {
  return picture.batches.size() == 1 ? picture.batches[0] : evened(mean_of(picture));
}

}  // namespace cuticle::study
