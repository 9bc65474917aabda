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
Real value_of(const Prepared<Real>& prepared, int quantity, const Directions<Real>& d) {
  if constexpr (requires { evaluate_directions(prepared, quantity, d); })
    return evaluate_directions(prepared, quantity, d).x;
  else
    return Real(0.0);
}

template <class Real>
bool holds(const Prepared<Real>& prepared) {
  if constexpr (requires { holds_in_batch(prepared); })
    return holds_in_batch(prepared);
  else
    return true;
}

double count(std::span<const float> numbers, bool density, std::span<const Place> places) {
  if (!holds(from_numbers<Prepared<float>>(numbers.data()))) return 0;
  const std::vector<Counted> counted(numbers.begin(), numbers.end());
  const auto prepared = from_numbers<Prepared<Counted>>(counted.data());
  Counted::operations = 0;
  for (const Place& p : places)
    value_of(prepared, density ? CUTICLE_QUANTITY_PDF : CUTICLE_QUANTITY_S,
             directions_between(CountedVector(p.light[0], p.light[1], p.light[2]),
                                CountedVector(p.viewer[0], p.viewer[1], p.viewer[2]), Counted(p.h)));
  return double(Counted::operations) / double(places.size());
}

[[maybe_unused]] const bool handed_in = bench::hand_in(CUTICLE_NAME(CUTICLE_BATCH_MODEL), count);

}  // namespace
}  // namespace cuticle::bsdf::CUTICLE_BATCH_MODEL
