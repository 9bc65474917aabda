#pragma once
// How far a picture of hair is from another.
#include <vector>

#include "core/image/image.h"

namespace cuticle::study {

/// Errors of one picture against the truth's, a mean for each tile of 16 x 16 pixels where either of the two covers
/// some: of coverage (|difference of alpha|), and of colour (|difference of premultiplied luminance| over the mean of
/// the truth's, over the same pixels).
struct PictureErrors {
  std::vector<double> coverage = {}, color = {};
};
PictureErrors compare(const Image& picture, const Image& truth);
/// The mean over the tiles; 0 where there is none.
double mean_error(const std::vector<double>& errors);

}  // namespace cuticle::study
