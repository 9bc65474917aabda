#pragma once
#include "strands/shaping/shaping.h"

namespace cuticle::strands::clumping {

struct Parameters {
  double strands_per_lock = 20;
  float strength = 0.8f, profile = 1;
};
void describe(registry::Members& members, Parameters& p);

}  // namespace cuticle::strands::clumping
