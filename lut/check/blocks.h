#pragma once
#include "core/image/image.h"

namespace cuticle::lut::check {

/// Of the 4 x 4 blocks that vary, the share (0 .. 1) whose numbers stand on 3, 7 or 15 equal steps between the block's
/// least and largest, as values or as the bits of half floats: what BC1 .. BC7 leave behind. A block of other data does
/// so by chance once in ten million.
double share_of_stepped_blocks(const Image& image);

/// Whether every square of `side` texels holds one number for each channel: a smaller picture, enlarged.
bool made_of_squares(const Image& image, int side);

}  // namespace cuticle::lut::check
