#pragma once
// How far a picture of hair is from another.
#include "core/image/image.h"

namespace cuticle::study {

/// Errors of one picture against the truth's: coverage (alpha) and colour (premultiplied linear radiance, over the
/// truth's mean where it covers). Means are over all pixels that either of the two covers.
struct PictureError {
  double coverage = 0, p95_coverage = 0, max_coverage = 0, coverage_bias = 0, color = 0;
};
/// Both of R, G, B, A and of one size.
PictureError compare(const Image& picture, const Image& truth);

}  // namespace cuticle::study
