#pragma once
// How many fibres lie behind each other in hair.
#include "strands/groom.h"

namespace cuticle::strands {

/// The projected area of all fibres over the area that they cover together, mean of the views along the three axes:
/// about the number of fibres that a ray through the hair meets. The covered area is that of squares of 1/64 of the
/// hair's largest side that a fibre's axis passes. 0 of hair without length. Test: thickness_test.
double optical_thickness(const Groom& groom);

}  // namespace cuticle::strands
