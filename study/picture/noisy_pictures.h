#pragma once
// Differences between pictures that have noise, measured without it.
#include <array>
#include <span>
#include <vector>

#include "core/image/image.h"

namespace cuticle::study {

/// A picture as means of independent batches of paths; batch k of every traced picture has the same seed. A picture
/// without noise has one batch. Linear, premultiplied.
struct NoisyPicture {
  std::vector<Image> batches;
  const Image& batch(std::size_t k) const { return batches[batches.size() == 1 ? 0 : k]; }
};
/// The mean of the batches.
Image mean_of(const NoisyPicture& picture);

inline constexpr int k_tile = 8;  ///< pixels a side: what errors of pictures are means over

/// Squares of differences, relative to a truth: of each tile the mean over its pixels and colours of the squared
/// difference, over the square of the truth's mean in the tile plus that of its mean over all hair. Only pixels that
/// any picture covers count. What noise adds to a square is left out: with differences D_k of K batches the square is
/// (sum D)^2 - sum D^2 over K (K - 1), whose expectation is that of pictures without noise; single values may be below
/// 0. Test: noisy_pictures_test.cpp.
class RelativeSquares {
 public:
  /// The first is the truth. All have one size.
  explicit RelativeSquares(std::vector<const NoisyPicture*> pictures);

  /// Of the step from a to b times that from c to d (the same pictures twice: the square): one value for each tile that
  /// hair covers, weighted so that their mean is the mean over all pixels. Exactly linear in both steps.
  std::vector<double> tiles(const NoisyPicture& a, const NoisyPicture& b, const NoisyPicture& c,
                            const NoisyPicture& d) const;
  std::vector<double> tiles(const NoisyPicture& a, const NoisyPicture& b) const { return tiles(a, b, a, b); }
  /// The same of the tiles' mean colours in the place of the pixels': how much light arrives where, whatever single
  /// pixels show. Noise is less than a pixel's by the root of the pixels in a tile.
  std::vector<double> light(const NoisyPicture& a, const NoisyPicture& b) const;
  double mean(const NoisyPicture& a, const NoisyPicture& b, const NoisyPicture& c, const NoisyPicture& d) const;

 private:
  struct Tile {
    std::vector<std::size_t> pixels;
    double scale[3] = {1, 1, 1};  ///< of the colours: one over what squares are relative to
  };
  struct Steps {
    const NoisyPicture &a, &b, &c, &d;
  };
  /// Of the sums of some pixels' differences, as they are: without noise, not relative.
  double square(const Steps& steps, std::span<const std::size_t> pixels, std::size_t channel) const;
  std::size_t batches_ = 1;
  std::vector<Tile> tiles_;
  double pixels_ = 0;
};

/// Light of a picture over that of a truth, and half of its 95 % interval by what the batches differ.
struct LightShare {
  double share = 0, half_width = 0;
};
/// Of red, green and blue, over all pixels; the interval by the batches' differences from the share (a ratio
/// estimator: batches have the same seeds in both pictures). Without noise in either it is 0.
std::array<LightShare, 3> light_shares(const NoisyPicture& picture, const NoisyPicture& truth);

/// Squared relative error of the mean radiance of each strand that is first in four pixels or more, over that of all
/// strands; without what noise adds, as above. `strands`: of each pixel, -1: none.
std::vector<double> strand_squares(const NoisyPicture& picture, const NoisyPicture& truth,
                                   const std::vector<int>& strands);

}  // namespace cuticle::study
