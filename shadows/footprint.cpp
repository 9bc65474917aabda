#include "shadows/footprint.h"

#include "strands/statistics.h"

namespace cuticle::shadows {

double default_footprint_radius(const strands::Groom& groom) {
  return groom.strand_count() == 0 ? 0 : 2 * strands::statistics(groom).spacing;
}

}  // namespace cuticle::shadows
