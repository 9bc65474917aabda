#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <cuticle/study/model_check/checks/checks.h>
#include <cuticle/study/model_check/sphere_quadrature.h>

namespace cuticle::study::model_check {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double tails[] = {-8, -4, -2, 0, 2, 4, 8};  // in ranges of a lobe's middle half
constexpr double distances[] = {0, 1e-3, 3e-3, 1e-2, 3e-2, 0.1};

std::vector<double> even(double low, double high, int parts) {
  std::vector<double> breaks;
  for (int k = 0; k <= parts; ++k) breaks.push_back(low + (high - low) * k / parts);
  return breaks;
}

/// Middle and range of the middle half of the values.
struct Extent {
  double middle = 0, range = 0;
};
Extent extent_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values[values.size() * 3 / 4] - values[values.size() / 4]};
}

/// A lobe's samples, and places around it where too few of them fall to show its tails. Few samples may come from a
/// narrow ring: they stand for all of it.
void add_lobe(const std::vector<Seed>& lobe, std::vector<Seed>& seeds) {
  std::vector<double> theta, phi;
  for (const Seed& seed : lobe) {
    theta.push_back(seed.theta);
    phi.push_back(seed.phi);
  }
  const bool few = lobe.size() < 24;
  const Extent along = extent_of(theta), around = few ? Extent{0, pi} : extent_of(phi);
  // What reaches everywhere is shown by a few.
  const bool broad = std::max(along.range, around.range) > wide_lobe;
  const std::size_t stride = broad ? std::max<std::size_t>(1, lobe.size() / 64) : 1;
  for (std::size_t i = 0; i < lobe.size(); i += stride)
    seeds.push_back({lobe[i].theta, lobe[i].phi, along.range, around.range});
  for (double t : tails)
    for (double p : tails)
      seeds.push_back({along.middle + t * along.range, around.middle + p * around.range, along.range, around.range});
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
