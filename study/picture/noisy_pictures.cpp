#include "study/picture/noisy_pictures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <boost/math/distributions/students_t.hpp>

#include "core/expect.h"

namespace cuticle::study {
namespace {

double luminance(const float* pixel) {
  return 0.2126 * double(pixel[0]) + 0.7152 * double(pixel[1]) + 0.0722 * double(pixel[2]);
}

/// The mean over pairs of different batches of D_j E_k, for sums of D, E and D E over the batches.
double without_noise(double sum_d, double sum_e, double sum_de, std::size_t batches) {
  if (batches == 1) return sum_de;
  return (sum_d * sum_e - sum_de) / (double(batches) * double(batches - 1));
}

bool is_covered(const std::vector<const NoisyPicture*>& pictures, std::size_t pixel) {
  return std::ranges::any_of(pictures, [&](const NoisyPicture* picture) {
    return std::ranges::any_of(picture->batches, [&](const Image& image) { return image.pixels[4 * pixel + 3] > 0; });
  });
}

std::array<double, 3> light_of(const Image& image) {
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    if (k % 4 < 3) sum[k % 4] += double(image.pixels[k]);
  return sum;
}

/// Half of a 95 % interval in standard errors, over so many values.
double student_95(std::size_t values) {
  return boost::math::quantile(boost::math::students_t(std::max(1.0, double(values) - 1)), 0.975);
}

struct Mean3 {
  double sum[3] = {0, 0, 0}, count = 0;
  void add(const float* pixel) {
    for (int c = 0; c < 3; ++c) sum[c] += double(pixel[c]);
    ++count;
  }
  double square(int c) const { return count > 0 ? sum[c] / count * sum[c] / count : 0; }
};

}  // namespace

Image mean_of(const NoisyPicture& picture) {
  Image mean = picture.batches.front();
  for (std::size_t k = 1; k < picture.batches.size(); ++k)
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] += picture.batches[k].pixels[i];
  for (float& value : mean.pixels) value /= float(picture.batches.size());
  return mean;
}

std::array<LightShare, 3> light_shares(const NoisyPicture& picture, const NoisyPicture& truth) {
  const std::size_t batches = std::max(picture.batches.size(), truth.batches.size());
  std::vector<std::array<double, 3>> light(batches), expected(batches);
  std::array<double, 3> sum{}, whole{};
  for (std::size_t k = 0; k < batches; ++k) {
    light[k] = light_of(picture.batch(k)), expected[k] = light_of(truth.batch(k));
    for (std::size_t c = 0; c < 3; ++c) sum[c] += light[k][c], whole[c] += expected[k][c];
  }
  std::array<LightShare, 3> shares;
  for (std::size_t c = 0; c < 3; ++c) {
    const double of = std::max(whole[c], 1e-12);
    double squares = 0;
    for (std::size_t k = 0; k < batches; ++k) squares += std::pow(light[k][c] - sum[c] / of * expected[k][c], 2);
    const double error = batches > 1 ? std::sqrt(squares * double(batches) / double(batches - 1)) / of : 0;
    shares[c] = {sum[c] / of, error * student_95(batches)};
  }
  return shares;
}

RelativeSquares::RelativeSquares(std::vector<const NoisyPicture*> pictures) {
  const Image truth = mean_of(*pictures.front());
  for (const NoisyPicture* picture : pictures) {
    batches_ = std::max(batches_, picture->batches.size());
    CUTICLE_EXPECT(picture->batches.size() == 1 || picture->batches.size() == batches_, "as many batches in each");
  }
  std::map<std::pair<int, int>, Tile> tiles;
  std::map<std::pair<int, int>, Mean3> means;
  Mean3 all;
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      const std::size_t pixel = std::size_t(y) * std::size_t(truth.width) + std::size_t(x);
      if (!is_covered(pictures, pixel)) continue;
      const std::pair<int, int> place(y / k_tile, x / k_tile);
      tiles[place].pixels.push_back(pixel);
      means[place].add(&truth.pixels[4 * pixel]);
      all.add(&truth.pixels[4 * pixel]);
    }
  pixels_ = std::max(all.count, 1.0);
  for (auto& [place, tile] : tiles) {
    for (int c = 0; c < 3; ++c) tile.scale[c] = 1 / std::max(means[place].square(c) + all.square(c), 1e-12);
    tiles_.push_back(std::move(tile));
  }
}

double RelativeSquares::square(const Steps& steps, std::span<const std::size_t> pixels, std::size_t channel) const {
  double sum_d = 0, sum_e = 0, sum_de = 0;
  for (std::size_t k = 0; k < batches_; ++k) {
    double first = 0, second = 0;
    for (const std::size_t pixel : pixels) {
      const std::size_t at = 4 * pixel + channel;
      first += double(steps.b.batch(k).pixels[at]) - double(steps.a.batch(k).pixels[at]);
      second += double(steps.d.batch(k).pixels[at]) - double(steps.c.batch(k).pixels[at]);
    }
    sum_d += first, sum_e += second, sum_de += first * second;
  }
  return without_noise(sum_d, sum_e, sum_de, batches_);
}

std::vector<double> RelativeSquares::tiles(const NoisyPicture& a, const NoisyPicture& b, const NoisyPicture& c,
                                           const NoisyPicture& d) const {
  std::vector<double> values;
  for (const Tile& tile : tiles_) {
    double sum = 0;
    for (const std::size_t& pixel : tile.pixels)
      for (std::size_t channel = 0; channel < 3; ++channel)
        sum += square({a, b, c, d}, {&pixel, 1}, channel) * tile.scale[channel] / 3;
    values.push_back(sum * double(tiles_.size()) / pixels_);
  }
  return values;
}

std::vector<double> RelativeSquares::light(const NoisyPicture& a, const NoisyPicture& b) const {
  std::vector<double> values;
  for (const Tile& tile : tiles_) {
    double sum = 0;
    for (std::size_t channel = 0; channel < 3; ++channel)
      sum += square({a, b, a, b}, tile.pixels, channel) * tile.scale[channel] / 3;
    values.push_back(sum / double(tile.pixels.size()) * double(tiles_.size()) / pixels_);
  }
  return values;
}

double RelativeSquares::mean(const NoisyPicture& a, const NoisyPicture& b, const NoisyPicture& c,
                             const NoisyPicture& d) const {
  double sum = 0;
  const std::vector<double> values = tiles(a, b, c, d);
  for (const double value : values) sum += value;
  return sum / double(std::max<std::size_t>(values.size(), 1));
}

std::vector<double> strand_squares(const NoisyPicture& picture, const NoisyPicture& truth,
                                   const std::vector<int>& strands) {
  struct Sums {
    std::vector<double> difference;
    double count = 0;
  };
  const std::size_t batches = std::max(picture.batches.size(), truth.batches.size());
  const Image mean = mean_of(truth);
  std::map<int, Sums> sums;
  double total = 0, pixels = 0;
  for (std::size_t p = 0; p < strands.size(); ++p) {
    if (strands[p] < 0) continue;
    Sums& of = sums[strands[p]];
    of.difference.resize(batches);
    for (std::size_t k = 0; k < batches; ++k)
      of.difference[k] += luminance(&picture.batch(k).pixels[4 * p]) - luminance(&truth.batch(k).pixels[4 * p]);
    ++of.count;
    total += luminance(&mean.pixels[4 * p]);
    ++pixels;
  }
  const double scale = std::max(total / std::max(pixels, 1.0), 1e-12);
  std::vector<double> squares;
  for (const auto& [strand, of] : sums) {
    if (of.count < 4) continue;
    double sum = 0, square = 0;
    for (const double difference : of.difference) {
      const double relative = difference / of.count / scale;
      sum += relative, square += relative * relative;
    }
    squares.push_back(without_noise(sum, sum, square, batches));
  }
  return squares;
}

}  // namespace cuticle::study
