#include "viz/color/ramp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>

namespace cuticle::viz {
namespace {

using Stops = std::array<glm::dvec3, 17>;

/// Every sixteenth of matplotlib's viridis.
constexpr Stops k_sequential = {{{.2670, .0049, .3294},
                                 {.2823, .0950, .4173},
                                 {.2788, .1755, .4834},
                                 {.2590, .2515, .5247},
                                 {.2297, .3224, .5457},
                                 {.1994, .3876, .5546},
                                 {.1727, .4488, .5579},
                                 {.1490, .5081, .5573},
                                 {.1276, .5669, .5506},
                                 {.1206, .6258, .5335},
                                 {.1579, .6838, .5017},
                                 {.2461, .7389, .4520},
                                 {.3692, .7889, .3829},
                                 {.5160, .8312, .2943},
                                 {.6785, .8637, .1895},
                                 {.8456, .8873, .0997},
                                 {.9932, .9062, .1439}}};
/// Every sixteenth of Moreland's cool to warm.
constexpr Stops k_diverging = {{{.2298, .2987, .7537},
                                {.3042, .4069, .8453},
                                {.3837, .5102, .9178},
                                {.4677, .6056, .9685},
                                {.5543, .6901, .9955},
                                {.6408, .7608, .9978},
                                {.7240, .8149, .9757},
                                {.8006, .8504, .9300},
                                {.8674, .8644, .8626},
                                {.9256, .8255, .7711},
                                {.9595, .7670, .6741},
                                {.9697, .6905, .5751},
                                {.9567, .5980, .4773},
                                {.9214, .4914, .3834},
                                {.8654, .3711, .2958},
                                {.7906, .2314, .2162},
                                {.7057, .0156, .1502}}};

std::pair<double, double> extent(std::span<const float> values) {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    lower = std::min(lower, double(value));
    upper = std::max(upper, double(value));
  }
  return lower <= upper ? std::pair(lower, upper) : std::pair(0.0, 1.0);
}

/// Above `lower` by more than rounding, so that the scale has a width.
double above(double lower, double upper) {
  const double least = 1e-6 * std::max(std::abs(lower), 1e-6);
  return std::max(upper, lower + least);
}

}  // namespace

glm::dvec3 ramp_color(Ramp ramp, double fraction) {
  const Stops& stops = ramp == Ramp::sequential ? k_sequential : k_diverging;
  const double place = std::clamp(fraction, 0.0, 1.0) * double(stops.size() - 1);
  const auto first = std::min(std::size_t(place), stops.size() - 2);
  return glm::mix(stops[first], stops[first + 1], place - double(first));
}

double ColorScale::fraction(double value) const {
  if (!logarithmic) return (value - lower) / (upper - lower);
  return value > 0 ? std::log(value / lower) / std::log(upper / lower) : 0;
}

glm::dvec3 ColorScale::color(double value) const {
  return std::isfinite(value) ? ramp_color(ramp, fraction(value)) : glm::dvec3(0.9);
}

ColorScale sequential_scale(std::span<const float> values, std::string title) {
  const auto [lower, upper] = extent(values);
  return {Ramp::sequential, lower, above(lower, upper), false, std::move(title)};
}

ColorScale diverging_scale(std::span<const float> values, double neutral, std::string title) {
  const auto [lower, upper] = extent(values);
  const double reach = std::max({std::abs(lower - neutral), std::abs(upper - neutral), 1e-6});
  return {Ramp::diverging, neutral - reach, neutral + reach, false, std::move(title)};
}

ColorScale logarithmic_scale(std::span<const float> values, double decades, std::string title) {
  const double upper = std::max(extent(values).second, 1e-30);
  double lower = upper;
  for (const float value : values)
    if (value > 0) lower = std::min(lower, double(value));
  lower = std::max(lower, upper * std::pow(10.0, -decades));
  return {Ramp::sequential, std::min(lower, 0.9 * upper), upper, true, std::move(title)};
}

}  // namespace cuticle::viz
