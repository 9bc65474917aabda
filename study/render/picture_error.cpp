#include "study/render/picture_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cuticle::study {

namespace {

double luminance(const Image& image, std::size_t pixel) {
  const float* p = image.pixels.data() + 4 * pixel;
  return 0.2126 * double(p[0]) + 0.7152 * double(p[1]) + 0.0722 * double(p[2]);
}

}  // namespace

PictureErrors compare(const Image& picture, const Image& truth) {
  constexpr int k_tile = 16;
  PictureErrors errors;
  double brightness = 0, pixels = 0;
  for (int y0 = 0; y0 < truth.height; y0 += k_tile)
    for (int x0 = 0; x0 < truth.width; x0 += k_tile) {
      double coverage = 0, color = 0, count = 0;
      for (int y = y0; y < std::min(y0 + k_tile, truth.height); ++y)
        for (int x = x0; x < std::min(x0 + k_tile, truth.width); ++x) {
          const float alpha = picture.at(x, y, 3), wanted = truth.at(x, y, 3);
          if (alpha <= 0 && wanted <= 0) continue;
          const std::size_t pixel = std::size_t(y) * std::size_t(truth.width) + std::size_t(x);
          coverage += std::abs(double(alpha) - double(wanted));
          color += std::abs(luminance(picture, pixel) - luminance(truth, pixel));
          brightness += luminance(truth, pixel);
          ++count;
        }
      if (count == 0) continue;
      errors.coverage.push_back(coverage / count);
      errors.color.push_back(color / count);
      pixels += count;
    }
  if (brightness > 0)
    for (double& error : errors.color) error *= pixels / brightness;
  return errors;
}

double mean_error(const std::vector<double>& errors) {
  return errors.empty() ? 0 : std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
}

}  // namespace cuticle::study
