#include "viz/draw/ticks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cuticle::viz {
namespace {

std::vector<double> multiples(double step, double lower, double upper) {
  std::vector<double> found;
  const double slack = 1e-9 * (upper - lower);
  for (double k = std::ceil((lower - slack) / step); k * step <= upper + slack; ++k)
    found.push_back(k == 0 ? 0 : k * step);
  return found;
}

double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace

std::vector<double> ticks(double lower, double upper, int count) {
  if (!(upper > lower) || count < 1) return {};
  return multiples(round_step((upper - lower) / count), lower, upper);
}

std::vector<double> logarithmic_ticks(double lower, double upper, int count) {
  if (!(lower > 0) || !(upper > lower)) return {};
  const double decades = std::log10(upper / lower);
  const int step = std::max(1, int(std::ceil(decades / std::max(count, 1))));
  std::vector<double> found;
  const int first = int(std::ceil(std::log10(lower) - 1e-9)), last = int(std::floor(std::log10(upper) + 1e-9));
  for (int power = last; power >= first; power -= step) found.insert(found.begin(), std::pow(10.0, power));
  return found.size() < 2 ? ticks(lower, upper, count) : found;
}

std::vector<double> degree_ticks(double lower, double upper, int count) {
  for (const double step : {5.0, 10.0, 15.0, 30.0, 45.0, 90.0})
    if ((upper - lower) / step <= count) return multiples(step, lower, upper);
  return multiples(180, lower, upper);
}

std::vector<Tick> labelled(const std::vector<double>& ticks) {
  std::vector<Tick> list;
  for (int digits = 5; digits <= 17; ++digits) {
    list.clear();
    for (const double at : ticks) list.push_back({at, fmt::format("{:.{}g}", at, digits)});
    const auto same = [](const Tick& a, const Tick& b) { return a.text == b.text; };
    if (std::adjacent_find(list.begin(), list.end(), same) == list.end()) return list;
  }
  return list;
}

}  // namespace cuticle::viz
