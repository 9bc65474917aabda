#pragma once
// Statistics of a study: means with intervals, medians of timings, fronts, knees, exponents.
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "study/engine/study.h"

namespace cuticle::study {

/// A value and the interval that holds it with 95 %; without one (a single item) low is 0 and high is infinite.
struct Interval {
  double value = 0, low = 0, high = 0;
};
/// Whether a is below b for certain: their intervals do not overlap.
inline bool is_below(const Interval& a, const Interval& b) { return a.high < b.low; }

/// Errors of the items as one number and by quantiles; NaN items are left out. The interval of the mean is the normal
/// one over the items (that of the root of the mean square by its squares).
struct ErrorSummary {
  Interval mean;
  double median = 0, percentile_95 = 0, percentile_99 = 0, maximum = 0;
  std::size_t items = 0;
};
/// Which items: settings are chosen on the even ones and judged on the odd ones.
enum class Items { all, choosing, judging };
ErrorSummary summarise(std::span<const double> errors, Mean mean, Items items = Items::all);

/// Median and its interval by order statistics (binomial, 95 %; fewer than six samples: the least and the greatest).
Interval median_interval(std::vector<double> samples);

/// A point of cost and error, both lower is better.
struct CostAndError {
  Interval cost, error;
};
/// Where a point stands: on the front by its values; and beaten for certain: another is below it in both.
struct FrontPlace {
  bool on_front = false, surely_beaten = false;
};
std::vector<FrontPlace> pareto_front(std::span<const CostAndError> points);

/// The place in `points` of the least cost with an error of at most `most`; of the least error with a cost of at most.
std::optional<std::size_t> cheapest_for(std::span<const CostAndError> points, double most);
std::optional<std::size_t> most_accurate_within(std::span<const CostAndError> points, double most);

/// The front's point that is farthest below the line between its ends, on logarithmic axes; none: fewer than three
/// points of positive cost and error.
std::optional<std::size_t> knee(std::span<const CostAndError> points);

/// y ~ x^exponent by least squares of the logarithms, and the standard error of the exponent; none: fewer than three
/// points, or all of one x.
struct Exponent {
  double value = 0, standard_error = 0;
};
std::optional<Exponent> scaling_exponent(std::span<const double> x, std::span<const double> y);

}  // namespace cuticle::study
