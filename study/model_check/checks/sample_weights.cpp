// What a renderer multiplies by: each weight is S / pdf at the direction drawn, and their mean is the albedo.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

constexpr std::array<Situation, 3> sample_weights_situations = {
    {{Absorption::coloured, Roughness::usual, Tilt::given},
     {Absorption::coloured, Roughness::narrow, Tilt::strong},
     {Absorption::none, Roughness::wide, Tilt::given}}};
constexpr double deviations = 4.5;  // of the mean that chance may explain; beyond once in 150,000 means

struct Weights {
  double inconsistency = 0;  ///< largest |weight pdf - S| / S
  double surplus = 0;        ///< |mean - albedo| beyond what chance explains
  double largest = 0;        ///< weight
};

/// Mean of one channel, and the standard error of the mean.
std::pair<double, double> mean_of(const std::vector<bsdf::Sample>& samples, int channel) {
  double sum = 0, squares = 0;
  for (const bsdf::Sample& sample : samples) sum += sample.weight[channel];
  const double mean = sum / double(samples.size());
  for (const bsdf::Sample& sample : samples) squares += std::pow(sample.weight[channel] - mean, 2);
  return {mean, std::sqrt(squares) / double(samples.size())};
}

double inconsistency(const Scatterer& scatterer, const bsdf::Point& view, std::span<const bsdf::Sample> samples) {
  std::vector<bsdf::Point> points;
  for (const bsdf::Sample& sample : samples) points.push_back(point_of(sample, view));
  const std::vector<glm::dvec3> truth = values_at(scatterer.scattering, points);
  double peak = 0, worst = 0;
  for (const glm::dvec3& s : truth) peak = std::max(peak, largest(s));
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (largest(truth[i]) > 1e-9 * peak)
      worst = std::max(worst, largest(samples[i].weight * samples[i].pdf - truth[i]) / largest(truth[i]));
  return worst;
}

Weights measure(const Scatterer& scatterer, const bsdf::Point& view, std::size_t count, std::uint64_t seed) {
  const std::vector<bsdf::Sample> samples = draw(scatterer, view, count, seed);
  const std::span<const bsdf::Sample> compared = std::span(samples).first(count / 4);
  const glm::dvec3 energy = scattered_energy(scatterer, view, 3e-4).value;
  Weights weights{.inconsistency = inconsistency(scatterer, view, compared)};
  for (int c = 0; c < 3; ++c) {
    const auto [mean, error] = mean_of(samples, c);
    weights.surplus = std::max(weights.surplus, std::abs(mean - energy[c]) - deviations * error);
  }
  for (const bsdf::Sample& sample : samples) weights.largest = std::max(weights.largest, largest(sample.weight));
  return weights;
}

}  // namespace

Verdict sample_weights(const Subject& subject, const Options& options) {
  Worst inconsistency, surplus, heaviest;
  for (const Scatterer& scatterer :
       scatterers(subject, std::span(sample_weights_situations).first(options.quick ? 1 : 3))) {
    if (!scatterer.sample) return skipped("it has no sampler");
    for (const bsdf::Point& view : sampling_views(subject, options)) {
      const Weights weights = measure(scatterer, view, options.quick ? 4096 : 16384, options.seed);
      const std::string place = where(subject, scatterer, view);
      inconsistency.note(weights.inconsistency, place);
      surplus.note(weights.surplus, place);
      heaviest.note(weights.largest, place);
    }
  }
  return judged(
      std::max(inconsistency.value, surplus.value), 5e-4 + 1e3 * subject.rounding,
      fmt::format("weight pdf / S off 1 by {:.1e} at {}; mean off the energy of S by {:.1e} beyond chance at {}; "
                  "largest weight {:.3g}",
                  inconsistency.value, inconsistency.where, std::max(surplus.value, 0.0), surplus.where,
                  heaviest.value));
}

}  // namespace cuticle::study::model_check
