#pragma once
// From a grooming specification to hair.
#include "strands/growing/specification.h"
#include "strands/spline/smooth.h"

namespace cuticle::strands {

/// What growing met on its way.
struct GrowthReport {
  RootReport roots;
  Deviation deviation;        ///< of the smoothed control hairs from their control polylines
  std::size_t moved_out = 0;  ///< drawn vertices that lay inside the mesh and were moved to its surface
};
struct Grown {
  Head head;      ///< `scalp` is what carries the hair
  Groom control;  ///< one hair per vertex of the scalp
  Groom drawn;    ///< of equal vertex counts; a prefix of the strands is a thinner groom
  GrowthReport report;
};

/// Control hairs planted and combed, smoothed, interpolated to area x density x share strands, shaped by the effects
/// that the specification names, and moved out of the head. The same specification gives the same hair on every machine
/// of equal floating point. Error: bad_input where no strand results, or as plant_control_hairs and place_roots.
Result<Grown> grow(const GroomingSpecification& specification);
/// The same on a head or body of one's own; strands.surface and strands.control_hairs are not used.
Result<Grown> grow(const GroomingSpecification& specification, Head head);

}  // namespace cuticle::strands
