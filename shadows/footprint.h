#pragma once
// The area that a transmittance is averaged over.
#include "strands/groom.h"

namespace cuticle::shadows {

/// Radius, metres, of the disc that transmittance is averaged over unless one is given: two fibre spacings, so four across
/// (strands::GroomStatistics::spacing); 0 for a groom without extent, a single ray. `groom` must be valid.
double default_footprint_radius(const strands::Groom& groom);

}  // namespace cuticle::shadows
