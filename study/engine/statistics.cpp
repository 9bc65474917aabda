#include "study/engine/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cuticle::study {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_normal_95 = 1.959964;

bool is_taken(Items items, std::size_t place) {
  return items == Items::all || (items == Items::choosing) == (place % 2 == 0);
}

/// The mean of values and its normal interval, which may reach below 0 where they may.
Interval mean_of(std::span<const double> values) {
  double sum = 0, squares = 0;
  for (double value : values) sum += value;
  const double count = double(values.size()), mean = sum / count;
  if (values.size() < 2) return {mean, 0, k_infinity};
  for (double value : values) squares += (value - mean) * (value - mean);
  const double half = k_normal_95 * std::sqrt(squares / (count - 1) / count);
  return {mean, mean - half, mean + half};
}

bool are_squares(Mean mean) { return mean == Mean::squares || mean == Mean::root_of_squares; }
bool is_root(Mean mean) { return mean == Mean::root_mean_square || mean == Mean::root_of_squares; }

double quantile(std::span<const double> sorted, double share) {
  return sorted[std::size_t(share * double(sorted.size() - 1))];
}

/// Places of the points in the order of cost, then of error.
std::vector<std::size_t> by_cost(std::span<const CostAndError> points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) { return std::pair(points[i].cost.value, points[i].error.value); };
    return key(a) < key(b);
  });
  return order;
}

std::vector<std::size_t> front_order(std::span<const CostAndError> points) {
  double best = k_infinity;
  std::vector<std::size_t> front;
  for (std::size_t i : by_cost(points))
    if (points[i].error.value < best) {
      best = points[i].error.value;
      front.push_back(i);
    }
  return front;
}

}  // namespace

ErrorSummary summarise(std::span<const double> errors, Mean mean, Items items) {
  std::vector<double> taken;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (is_taken(items, i) && std::isfinite(errors[i]))
      taken.push_back(are_squares(mean) ? errors[i] : std::abs(errors[i]));
  ErrorSummary summary;
  summary.items = taken.size();
  if (taken.empty()) return summary;
  std::ranges::sort(taken);
  summary.median = quantile(taken, 0.5);
  summary.percentile_95 = quantile(taken, 0.95);
  summary.percentile_99 = quantile(taken, 0.99);
  summary.maximum = taken.back();
  if (mean == Mean::root_mean_square)
    for (double& value : taken) value *= value;
  summary.mean = mean_of(taken);
  if (mean != Mean::squares) summary.mean.low = std::max(0.0, summary.mean.low);
  if (is_root(mean))
    for (double* value : {&summary.mean.value, &summary.mean.low, &summary.mean.high})
      *value = std::sqrt(std::max(0.0, *value));
  return summary;
}

Interval median_interval(std::vector<double> samples) {
  if (samples.empty()) return {0, 0, k_infinity};
  std::ranges::sort(samples);
  const std::size_t count = samples.size();
  const double median = (samples[(count - 1) / 2] + samples[count / 2]) / 2;
  if (count == 1) return {median, 0, k_infinity};
  // The greatest k with P(fewer than k of the samples lie below the median) <= 2.5 %; 0 becomes the ends.
  double below = std::pow(0.5, double(count)), term = below;
  std::size_t k = 0;
  while (below <= 0.025) {
    ++k;
    term *= double(count - k + 1) / double(k);
    below += term;
  }
  const std::size_t place = k == 0 ? 0 : k - 1;
  return {median, samples[place], samples[count - 1 - place]};
}

std::vector<FrontPlace> pareto_front(std::span<const CostAndError> points) {
  std::vector<FrontPlace> places(points.size());
  for (std::size_t i : front_order(points)) places[i].on_front = true;
  for (std::size_t i = 0; i < points.size(); ++i)
    places[i].surely_beaten = std::ranges::any_of(points, [&](const CostAndError& other) {
      return is_below(other.cost, points[i].cost) && is_below(other.error, points[i].error);
    });
  return places;
}

std::optional<std::size_t> cheapest_for(std::span<const CostAndError> points, double most) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].error.value <= most && (!best || points[i].cost.value < points[*best].cost.value)) best = i;
  return best;
}

std::optional<std::size_t> most_accurate_within(std::span<const CostAndError> points, double most) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].cost.value <= most && (!best || points[i].error.value < points[*best].error.value)) best = i;
  return best;
}

std::optional<std::size_t> knee(std::span<const CostAndError> points) {
  std::vector<std::size_t> front;
  for (std::size_t i : front_order(points))
    if (points[i].cost.value > 0 && points[i].error.value > 0) front.push_back(i);
  if (front.size() < 3) return {};
  const auto x = [&](std::size_t i) { return std::log(points[i].cost.value); };
  const auto y = [&](std::size_t i) { return std::log(points[i].error.value); };
  const std::size_t first = front.front(), last = front.back();
  const double slope = (y(last) - y(first)) / std::max(1e-300, x(last) - x(first));
  std::optional<std::size_t> found;
  double farthest = 0;
  for (std::size_t i : front)
    if (const double below = y(first) + slope * (x(i) - x(first)) - y(i); below > farthest) {
      farthest = below;
      found = i;
    }
  return found;
}

std::optional<Exponent> scaling_exponent(std::span<const double> x, std::span<const double> y) {
  std::vector<double> u, v;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] > 0 && y[i] > 0) {
      u.push_back(std::log(x[i]));
      v.push_back(std::log(y[i]));
    }
  if (u.size() < 3) return {};
  const double count = double(u.size());
  double mean_u = 0, mean_v = 0, uu = 0, uv = 0, rest = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    mean_u += u[i] / count;
    mean_v += v[i] / count;
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    uu += (u[i] - mean_u) * (u[i] - mean_u);
    uv += (u[i] - mean_u) * (v[i] - mean_v);
  }
  if (uu < 1e-12) return {};
  const double slope = uv / uu;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double off = v[i] - mean_v - slope * (u[i] - mean_u);
    rest += off * off;
  }
  return Exponent{slope, std::sqrt(rest / (count - 2) / uu)};
}

}  // namespace cuticle::study
