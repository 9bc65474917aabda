#pragma once
// Texels that minimise the error of a table after the engine's filter, instead of samples of the model.
#include <string>
#include <vector>

#include "lut/format.h"
#include "lut/table_set.h"

namespace cuticle::lut {

/// A channel with and without the fit, both in the stored format, as `certify` measures them.
struct ChannelFit {
  std::string channel;
  ChannelError unfitted, fitted;
  bool kept = true;  ///< false: the samples stayed, because the fit would have raised the maximum
};
struct TexelFit {
  TableSet set;  ///< fitted, stored and certified
  std::vector<ChannelFit> channels;
  double fit_ms = 0;  ///< of the fit, without both certifications
};

/// Fits every channel of a baked set: least squares over five points a texel each way (cell averages: the bins of
/// `certify`, on three rows a texel) of what bilinear filtering makes of the texels, none negative (Ceres); numbers are
/// then rounded to the format one after the other, each making up for the errors of its neighbours. Texels around which
/// the error would pass the largest one of the samples go back to them. Texels on a caustic keep their averages.
/// Inputs: the set as `bake` leaves it, not yet stored. Measured: within 1e-3 of the unconstrained optimum of a dense
/// solve at 32 x 32 (lut_fit_test); gains in lut/fit/README.md. Errors: as `certify`.
Result<TexelFit> fit_texels(const TableSet& baked, const Format& format, Progress& progress);

}  // namespace cuticle::lut
