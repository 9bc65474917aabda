#pragma once
// The chi-square statistic of a sampler against its density, for the check and for the diagnosis.
#include "study/model_check/subject.h"

namespace cuticle::study::model_check {

/// The probability that a chi-square variable of `freedom` degrees exceeds `value`: the regularised upper incomplete
/// gamma function Q(freedom / 2, value / 2), by series or continued fraction (Abramowitz and Stegun 6.5.29, 6.5.31).
/// Relative error below 1e-10 (model_check_test.cpp).
double chi_square_tail(double value, double freedom);

/// The probability of samples as uneven as `count` drawn ones if they followed the density, over bins that hold about
/// equally many each. For one view.
double sampler_probability(const Scatterer& scatterer, const bsdf::Point& view, std::size_t count, std::uint64_t seed);

}  // namespace cuticle::study::model_check
