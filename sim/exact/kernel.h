#pragma once
// What one instruction set's unit offers: substeps of a block of strands.
#include "sim/chains/chain_rows.h"

namespace cuticle::sim::exact {

/// By whether strands are pulled to the rest pose and whether there are spheres.
struct Kernels {
  chains::Advance<float> advance[2][2];
  chains::Advance<double> advance_double;  ///< both
};
/// Of the widest instruction set that this processor has.
const Kernels& best_kernels();

}  // namespace cuticle::sim::exact
