// Compiled once for each model with batch kernels (CMakeLists.txt): CUTICLE_BATCH_MODEL, <model_of_batch.h>.
#include "bench/counted.h"

#include <model_of_batch.h>

#include "bsdf/shared/directions.glslh"
#include "bench/operations.h"

#define CUTICLE_NAME_OF(name) #name
#define CUTICLE_NAME(name) CUTICLE_NAME_OF(name)

namespace cuticle::bsdf::CUTICLE_BATCH_MODEL {
namespace {

using bench::Counted, bench::Place;
using CountedVector = glm::vec<3, Counted>;

template <class Real>
Real value_of(const Packed<Real>& packed, int quantity, const Directions<Real>& d) {
  if constexpr (requires { evaluate_directions(packed, quantity, d); })
    return evaluate_directions(packed, quantity, d).x;
  else
    return Real(0.0);
}

template <class Real>
bool holds(const Packed<Real>& packed) {
  if constexpr (requires { holds_in_batch(packed); })
    return holds_in_batch(packed);
  else
    return true;
}

double count(const Packed<float>& packed, bool density, std::span<const Place> places) {
  if (!holds(packed)) return 0;
  Packed<Counted> numbers;
  for (int k = 0; k < CUTICLE_PACKED_COUNT; ++k) numbers.value[k] = double(packed.value[k]);
  Counted::operations = 0;
  for (const Place& p : places)
    value_of(numbers, density ? CUTICLE_QUANTITY_PDF : CUTICLE_QUANTITY_S,
             directions_between(CountedVector(p.light[0], p.light[1], p.light[2]),
                                CountedVector(p.viewer[0], p.viewer[1], p.viewer[2]), Counted(p.h)));
  return double(Counted::operations) / double(places.size());
}

[[maybe_unused]] const bool handed_in = bench::hand_in(CUTICLE_NAME(CUTICLE_BATCH_MODEL), count);

}  // namespace
}  // namespace cuticle::bsdf::CUTICLE_BATCH_MODEL
