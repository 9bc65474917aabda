#pragma once
// A picture of the light inside hair: each method's transmittance on a plane through the hair's middle.
#include <string>

#include "shadows/method.h"
#include "study/shadows/comparison.h"

namespace cuticle::cli {

struct ShadowCut {
  std::string file;  ///< PNG
  int size = 256;    ///< width and height of each method's picture, pixels
};

/// Draws the candidates side by side, in their order: white is lit, black is dark. The plane holds the direction to the
/// light, which is up, and the middle of the hair. Errors: the methods' own; bad_input naming the file.
Result<void> draw_cut(const ShadowCut& cut, const shadows::Casters& casters,
                      std::span<const study::Candidate> candidates);

}  // namespace cuticle::cli
