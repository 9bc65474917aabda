#pragma once
// Path-traced pictures as they are shown: their noise made even, their light kept.
#include "study/picture/noisy_pictures.h"

namespace cuticle::study {

/// The mean of the batches, for looking at, linear and premultiplied. Where a pixel is more than three times as bright
/// as the median of the covered pixels within three of it, what it has above that is spread over those within eight,
/// the more the nearer: the sum of all pixels stays. A picture of one batch has no noise and stays as it is. Errors are
/// never taken from it, but FLIP is. Test: noisy_pictures_test.cpp.
Image shown_picture(const NoisyPicture& picture);
/// The same of a mean that has noise.
Image evened(const Image& mean);

}  // namespace cuticle::study
