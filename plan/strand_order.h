#pragma once
// F10: the order of a scene's drawn strands, of which a level of detail draws the first.
#include "plan/strand_set.h"

namespace cuticle::plan {

/// Whether a prefix of the strands may stand for all: for the eye (a pass's level of detail) or for the light.
bool may_use_a_prefix(const scene::Scene& scene);

/// Each prefix of what is drawn is then spread over all of it (strands::spread_order). Does nothing where it is.
void put_in_spread_order(StrandSet& set);

}  // namespace cuticle::plan
