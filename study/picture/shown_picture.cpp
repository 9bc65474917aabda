#include "study/picture/shown_picture.h"

#include <algorithm>
#include <cmath>

namespace cuticle::study {
namespace {

constexpr int k_reach = 3;        ///< pixels to each side that the median is of
constexpr int k_spread = 8;       ///< pixels to each side that light is spread over
constexpr float k_outshines = 3;  ///< times the median around

float brightness(const Image& image, std::size_t pixel) {
  const float* rgba = image.pixels.data() + 4 * pixel;
  return 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2];
}

struct Neighbour {
  std::size_t pixel = 0;
  float distance = 0;
};

/// Covered pixels within reach of one, itself too.
std::vector<Neighbour> around(const Image& image, int x, int y, int reach) {
  std::vector<Neighbour> pixels;
  for (int j = std::max(0, y - reach); j <= std::min(image.height - 1, y + reach); ++j)
    for (int i = std::max(0, x - reach); i <= std::min(image.width - 1, x + reach); ++i)
      if (image.at(i, j, 3) > 0)
        pixels.push_back(
            {std::size_t(j) * std::size_t(image.width) + std::size_t(i), std::hypot(float(i - x), float(j - y))});
  return pixels;
}

float median_brightness(const Image& image, int x, int y) {
  std::vector<float> values;
  for (const Neighbour& near : around(image, x, y, k_reach)) values.push_back(brightness(image, near.pixel));
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// Of a pixel that outshines those around it, what it has above them goes to them, the more the nearer they are.
void spread(const Image& mean, int x, int y, Image& shown) {
  const std::size_t pixel = std::size_t(y) * std::size_t(mean.width) + std::size_t(x);
  const float most = k_outshines * median_brightness(mean, x, y), bright = brightness(mean, pixel);
  if (bright <= most) return;
  const auto share = [](const Neighbour& near) { return std::max(0.0f, 1 - near.distance / (k_spread + 1)); };
  const std::vector<Neighbour> takers = around(mean, x, y, k_spread);
  float shares = 0;
  for (const Neighbour& near : takers) shares += share(near);
  for (std::size_t c = 0; c < 3; ++c) {
    const float above = mean.pixels[4 * pixel + c] * (1 - most / bright);
    shown.pixels[4 * pixel + c] -= above;
    for (const Neighbour& near : takers) shown.pixels[4 * near.pixel + c] += above * share(near) / shares;
  }
}

}  // namespace

Image evened(const Image& mean) {
  Image shown = mean;
  for (int y = 0; y < mean.height; ++y)
    for (int x = 0; x < mean.width; ++x)
      if (mean.at(x, y, 3) > 0) spread(mean, x, y, shown);
  return shown;
}

Image shown_picture(const NoisyPicture& picture) {
  return picture.batches.size() == 1 ? picture.batches[0] : evened(mean_of(picture));
}

}  // namespace cuticle::study
