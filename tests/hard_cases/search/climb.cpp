#include "tests/hard_cases/search/climb.h"

#include <cmath>

namespace cuticle::hard_cases::search {
namespace {

double fold(double x) { return x < 0 ? -x : x > 1 ? 2 - x : x; }

Place place_by_chance(std::size_t size, RandomStream& chance) {
  Place place(size);
  for (double& at : place) {
    const double kind = chance.next_unit();
    at = kind < 0.3 ? 0.5 : kind < 0.4 ? 0 : kind < 0.5 ? 1 : chance.next_unit();
  }
  return place;
}

}  // namespace

Found climb(const Space& space, RandomStream& chance, int steps) {
  Found best{place_by_chance(space.size, chance)};
  best.error = error_at(space, best.place);
  double reach = 0.3;
  for (int step = 0; step < steps && reach > 1e-7 && !std::isinf(best.error); ++step) {
    Found next = best;
    for (double& at : next.place)
      if (chance.next_unit() < 0.4) at = fold(at + reach * (2 * chance.next_unit() - 1));
    next.error = error_at(space, next.place);
    if (next.error > best.error)
      best = next;
    else
      reach *= 0.93;
  }
  return best;
}

Found simplest(const Space& space, Found found, double bound) {
  for (double& at : found.place) {
    const double before = at;
    at = 0.5;
    const double error = error_at(space, found.place);
    if (error > bound)
      found.error = error;
    else
      at = before;
  }
  return found;
}

}  // namespace cuticle::hard_cases::search
