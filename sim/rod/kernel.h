#pragma once
// What one instruction set's unit offers.
#include "sim/chains/chain_rows.h"
#include "sim/rod/rows.glslh"

namespace cuticle::sim::rod {

/// By whether strands are pulled to a place (clumping) and whether there are spheres.
struct Kernels {
  chains::Advance<float> advance[2][2];
  chains::Advance<double> advance_double[2][2];
};

}  // namespace cuticle::sim::rod
