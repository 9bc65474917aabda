#pragma once
// F10: level of detail. Strands stand in an order of which each prefix is spread over all (spread_order.h); a prefix in
// proportion to screen coverage is drawn, as wide as to cover the area of all, with fewer vertices.
#include <cstdint>
#include <vector>

#include "core/view.h"
#include "strands/groom.h"

namespace cuticle::strands {

/// The strands named, in that order, with all that belongs to them.
Groom selected(const Groom& groom, const std::vector<std::uint32_t>& strands);

struct LevelOfDetail {
  std::uint32_t strands = 0;   ///< of the prefix
  std::uint32_t vertices = 0;  ///< of a strand
  double width = 1;            ///< factor on radii
};

/// Pixels of the picture that the bounds cover as a camera sees them, as an ellipse in their screen box; the whole
/// picture where the camera stands within them.
double covered_pixels(const Bounds& bounds, const Camera& camera);

/// The level at which a groom in spread order is drawn where it covers `covered_px` pixels: in full from `full_px` on,
/// at least the share `least` of it. The width makes up for the area (length x width) of the strands that are left out,
/// exactly. Strands have equal vertex counts. `full_px` > 0, 0 < `least` <= 1.
LevelOfDetail level_of_detail(const Groom& groom, double covered_px, double full_px, double least = 0.01);

/// The groom at a level: prefix, resampled, widened.
Groom at_level(const Groom& groom, const LevelOfDetail& level);

/// Difference of two grooms as a viewer sees it: area (length x width) per cell of a grid over the bounds of `full`,
/// seen along the three axes.
struct LevelError {
  double area = 0;   ///< |area of reduced / area of full - 1|
  double cells = 0;  ///< root mean square difference of the cells over the root mean square of full's
};
/// `cells`: along the longest side of the bounds, 1 .. 512.
LevelError level_error(const Groom& full, const Groom& reduced, int cells);

}  // namespace cuticle::strands
