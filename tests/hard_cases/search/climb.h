#pragma once
// From a place by chance up the error of a space, and what is found made simple.
#include "core/random.h"
#include "tests/hard_cases/search/space.h"

namespace cuticle::hard_cases::search {

struct Found {
  Place place;
  double error = 0;
};
/// Steps along some coordinates, which shrink where none goes up.
Found climb(const Space& space, RandomStream& chance, int steps);
/// Coordinates in the middle as far as the error stays above `bound`.
Found simplest(const Space& space, Found found, double bound);

}  // namespace cuticle::hard_cases::search
