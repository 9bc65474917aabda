#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <cuticle/study/model_check/checks/checks.h>
#include <cuticle/study/model_check/sphere_quadrature.h>

namespace cuticle::study::model_check {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double distances[] = {0, 1e-3, 3e-3, 1e-2, 3e-2, 0.1};

std::vector<double> even(double low, double high, int parts) {
  std::vector<double> breaks;
  for (int k = 0; k <= parts; ++k) breaks.push_back(low + (high - low) * k / parts);
  return breaks;
}

/// The range of the middle half of the values.
double middle_half(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() * 3 / 4] - values[values.size() / 4];
}

void add_lobe(const std::vector<Seed>& lobe, std::vector<Seed>& seeds) {
  std::vector<double> theta, phi;
  for (const Seed& seed : lobe) {
    theta.push_back(seed.theta);
    phi.push_back(seed.phi);
  }
  const bool few = lobe.size() < 24;  // it may be a narrow ring, of which they show little
  const double theta_scale = middle_half(theta), phi_scale = few ? pi : middle_half(phi);
  for (const Seed& seed : lobe) {
    seeds.push_back({seed.theta, seed.phi, theta_scale, phi_scale});
    for (int k = 0; few && k < 12; ++k) seeds.push_back({seed.theta, pi * ((k + 0.5) / 6 - 1), theta_scale, pi});
  }
}

std::vector<Seed> samples(const Scatterer& scatterer, const bsdf::Point& view) {
  std::map<int, std::vector<Seed>> lobes;
  for (const bsdf::Sample& sample : draw(scatterer, view, 4096, 20031109))
    if (std::isfinite(sample.theta_i) && std::isfinite(sample.phi))
      lobes[sample.lobe].push_back({sample.theta_i, std::remainder(sample.phi, 2 * pi)});
  std::vector<Seed> seeds;
  for (const auto& [lobe, own] : lobes) add_lobe(own, seeds);
  return seeds;
}

std::vector<Seed> around_the_mirror_direction(const bsdf::Point& view) {
  std::vector<Seed> seeds;
  for (double distance : distances)
    for (double side : {-1.0, 1.0})
      for (int k = 0; k < 24; ++k)
        seeds.push_back({-view.theta_o + side * distance, pi * ((k + 0.5) / 12 - 1), std::max(distance, 1e-3), pi});
  return seeds;
}

}  // namespace

Partition partition_for(const Scatterer& scatterer, const bsdf::Point& view) {
  return {even(-pi / 2, pi / 2, 8), even(-pi, pi, 6),
          scatterer.sample ? samples(scatterer, view) : around_the_mirror_direction(view)};
}

}  // namespace cuticle::study::model_check
