#pragma once
// The arithmetic of a model's batch formulas, counted: the shared text run over a number that counts what is done with
// it, with the functions that float takes.
#include <cmath>
#include <span>
#include <string_view>

#include "bsdf/model.h"

namespace cuticle::bench {

/// Two unit vectors (x along the fibre) and an offset.
struct Place {
  double light[3], viewer[3], h;
};

/// Sums, products, quotients, roots and comparisons for one point, the mean over the places, of S (`density`: of the
/// pdf) by the formulas of the batch; 0 where the model has none, or none for these parameters.
double operations_of(std::string_view model, std::span<const float> numbers, bool density,
                     std::span<const Place> places);

/// What the unit of one model (operations.cpp) hands in before main.
using CountOperations = double (*)(std::span<const float>, bool density, std::span<const Place>);
bool hand_in(std::string_view model, CountOperations count);

}  // namespace cuticle::bench
