// The samples against their density: narrow and wide lobes, tilted.
#include "study/model_check/checks/chi_square.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;
constexpr int theta_bins = 20, phi_bins = 16;
constexpr double least_expected = 10;
constexpr double accepted = 0.01;  // of the whole family of tests
constexpr std::array<Situation, 3> chi_square_situations = {
    {{Absorption::given, Roughness::narrow, Tilt::strong, Effort::draft},
     {Absorption::given, Roughness::wide, Tilt::strong, Effort::draft},
     {Absorption::given, Roughness::usual, Tilt::given, Effort::draft}}};
// Of the shares of all bins together: it adds less than half a deviation to the statistic of 65,536 samples.
constexpr double share_tolerance = 5e-4;

double lower_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (double n = a + 1; term > sum * 1e-16; n += 1) sum += term *= x / n;
  return sum;
}

/// Lentz's continued fraction of the upper function.
double upper_fraction(double a, double x) {
  double b = x + 1 - a, c = 1e300, d = 1 / b, value = d;
  for (int i = 1; i < 10000; ++i) {
    const double factor = -i * (i - a);
    b += 2;
    d = 1 / (factor * d + b);
    c = b + factor / c;
    value *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return value;
}

/// Inner edges that hold equal shares of the values, and where the values begin and end: beyond, a bin as wide as it
/// is may hold the tail of a lobe that its quadrature would not find.
std::vector<double> edges(std::vector<double> values, int bins, double low, double high) {
  std::sort(values.begin(), values.end());
  std::vector<double> all = {low};
  for (int k = 0; k <= bins; ++k) {
    const double edge = values[(values.size() - 1) * std::size_t(k) / std::size_t(bins)];
    if (edge - all.back() > 1e-7 && high - edge > 1e-7) all.push_back(edge);
  }
  all.push_back(high);
  return all;
}

std::size_t bin_of(const std::vector<double>& edges, double value) {
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return std::size_t(above - edges.begin()) - 1;
}

Partition bins_for(const std::vector<bsdf::Sample>& samples) {
  std::vector<double> theta, phi;
  for (const bsdf::Sample& sample : samples) {
    theta.push_back(sample.theta_i);
    phi.push_back(std::remainder(sample.phi, 2 * pi));
  }
  return {edges(theta, theta_bins, -pi / 2, pi / 2), edges(phi, phi_bins, -pi, pi)};
}

std::size_t bin_index(const Partition& bins, double theta, double phi) {
  return bin_of(bins.theta, theta) * (bins.phi.size() - 1) + bin_of(bins.phi, phi);
}

/// The share of the density in each bin.
std::vector<double> expected_shares(const Scatterer& scatterer, const bsdf::Point& view, const Partition& bins) {
  std::vector<double> shares((bins.theta.size() - 1) * (bins.phi.size() - 1));
  for (const Cell& cell : integrate_sphere(scatterer.pdf, view, bins, {.absolute = share_tolerance}).cells)
    shares[bin_index(bins, 0.5 * (cell.theta_low + cell.theta_high), 0.5 * (cell.phi_low + cell.phi_high))] +=
        cell.value.x;
  return shares;
}

/// The statistic over bins, those that expect few pooled into one.
double probability(const std::vector<double>& counts, const std::vector<double>& shares, double total) {
  double statistic = 0, pooled_count = 0, pooled_expected = 0;
  int used = 0;
  const auto add = [&](double count, double expected) {
    statistic += (count - expected) * (count - expected) / expected;
    ++used;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = shares[i] * total;
    if (expected >= least_expected) {
      add(counts[i], expected);
    } else {
      pooled_count += counts[i];
      pooled_expected += std::max(expected, 0.0);
    }
  }
  if (pooled_count > 0 || pooled_expected >= least_expected) add(pooled_count, std::max(pooled_expected, 1.0));
  return chi_square_tail(statistic, std::max(used - 1, 1));
}

}  // namespace

double chi_square_tail(double value, double freedom) {
  const double a = 0.5 * freedom, x = 0.5 * value;
  if (!(x > 0)) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  return x < a + 1 ? 1 - front * lower_series(a, x) : front * upper_fraction(a, x);
}

double sampler_probability(const Scatterer& scatterer, const bsdf::Point& view, std::size_t count, std::uint64_t seed) {
  const Partition bins = bins_for(draw(scatterer, view, 2048, seed ^ 0x9e3779b97f4a7c15u));
  std::vector<double> counts((bins.theta.size() - 1) * (bins.phi.size() - 1));
  for (const bsdf::Sample& sample : draw(scatterer, view, count, seed))
    counts[bin_index(bins, sample.theta_i, std::remainder(sample.phi, 2 * pi))] += 1;
  return probability(counts, expected_shares(scatterer, view, bins), double(count));
}

Verdict chi_square(const Subject& subject, const Options& options) {
  Worst least;
  std::size_t tests = 0;
  for (const Scatterer& scatterer :
       scatterers(subject, std::span(chi_square_situations).first(options.quick ? 2 : 3))) {
    if (!scatterer.sample || !scatterer.pdf) return skipped("it has no sampler");
    for (const bsdf::Point& view : sampling_views(subject, options)) {
      const double p = sampler_probability(scatterer, view, options.quick ? 4096 : 65536, options.seed + tests);
      least.note(-p, where(subject, scatterer, view));
      ++tests;
    }
  }
  // Bonferroni: the least of so many probabilities counts as that much larger.
  const double corrected = std::min(1.0, -least.value * double(tests));
  Verdict verdict =
      judged(-corrected, -accepted,
             fmt::format("p = {:.3g} over {} tests (Bonferroni), worst at {}", corrected, tests, least.where));
  verdict.measured = corrected;
  verdict.allowed = accepted;
  verdict.at_least = true;
  return verdict;
}

}  // namespace cuticle::study::model_check
