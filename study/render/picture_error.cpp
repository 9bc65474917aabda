#include "study/render/picture_error.h"

#include <algorithm>
#include <cmath>

namespace cuticle::study {

namespace {

double luminance(const Image& image, std::size_t pixel) {
  const float* p = image.pixels.data() + 4 * pixel;
  return 0.2126 * double(p[0]) + 0.7152 * double(p[1]) + 0.0722 * double(p[2]);
}

}  // namespace

PictureError compare(const Image& picture, const Image& truth) {
  PictureError error;
  std::vector<double> apart;
  double color = 0, brightness = 0;
  for (std::size_t pixel = 0; pixel < truth.pixels.size() / 4; ++pixel) {
    const double more = double(picture.pixels[4 * pixel + 3]) - double(truth.pixels[4 * pixel + 3]);
    if (picture.pixels[4 * pixel + 3] <= 0 && truth.pixels[4 * pixel + 3] <= 0) continue;
    apart.push_back(std::abs(more));
    error.coverage += std::abs(more);
    error.coverage_bias += more;
    color += std::abs(luminance(picture, pixel) - luminance(truth, pixel));
    brightness += luminance(truth, pixel);
  }
  if (apart.empty()) return error;
  std::ranges::sort(apart);
  error.coverage /= double(apart.size());
  error.coverage_bias /= double(apart.size());
  error.p95_coverage = apart[apart.size() * 95 / 100];
  error.max_coverage = apart.back();
  error.color = brightness > 0 ? color / brightness : 0;
  return error;
}

}  // namespace cuticle::study
