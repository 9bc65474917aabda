#pragma once
#include <functional>
#include <string>

#include "core/image/image.h"
#include "lut/manifest.h"

namespace cuticle::lut::check {

/// How far the probes' readings lie from the manifest.
struct Misfit {
  double largest = 0;  ///< in tolerances
  double typical = 0;  ///< mean of log(1 + distance) over probes and channels: no single one rules it
  std::string worst;   ///< "probe 3, channel M_TT: 0.12, wanted 0.34"
};

/// Gives a channel's stored number at texture coordinates.
using Reading = std::function<double(int channel, double u, double v)>;
/// Bilinear and clamped.
Reading reading_of(const Image& image);
/// A reading that is not finite counts as 1e6 tolerances.
Misfit misfit_of(const ManifestTable& table, const Reading& reading);

}  // namespace cuticle::lut::check
