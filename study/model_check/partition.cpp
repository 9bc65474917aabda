#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "study/model_check/checks/checks.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;
constexpr double tails[] = {-8, -4, -2, 0, 2, 4, 8};  // in ranges of a lobe's middle half
constexpr double outermost = 8;
// A closed form may have caustics, which many samples find; an average over the fibre has none, and its samples cost
// more.
constexpr std::size_t samples_of_caustics = 4096, samples_of_averages = 1024;
constexpr double distances[] = {0, 1e-3, 3e-3, 1e-2, 3e-2, 0.1};

std::vector<double> even(double low, double high, int parts) {
  std::vector<double> breaks;
  for (int k = 0; k <= parts; ++k) breaks.push_back(low + (high - low) * k / parts);
  return breaks;
}

/// Middle and range of the middle half of the values.
struct Extent {
  double middle = 0, range = 0;
  bool reaches(double value) const { return std::abs(value - middle) <= outermost * range; }
};
Extent extent_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values[values.size() * 3 / 4] - values[values.size() / 4]};
}

/// Where some samples leave a lobe in one direction alone, as those of a Cauchy distribution do, its tails hold energy
/// all along that ring or arc, which is as narrow as the lobe: places across it that stand for its whole length.
void add_long_tails(const std::vector<Seed>& lobe, const Extent& along, const Extent& around,
                    std::vector<Seed>& seeds) {
  const bool ring = std::any_of(lobe.begin(), lobe.end(), [&](const Seed& seed) {
    return along.reaches(seed.theta) && !around.reaches(seed.phi);
  });
  const bool arc = std::any_of(lobe.begin(), lobe.end(), [&](const Seed& seed) {
    return !along.reaches(seed.theta) && around.reaches(seed.phi);
  });
  for (double t : tails) {
    if (ring) seeds.push_back({along.middle + t * along.range, around.middle, along.range, pi});
    if (arc) seeds.push_back({along.middle, around.middle + t * around.range, pi, around.range});
  }
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
  add_long_tails(lobe, along, around, seeds);
  for (double t : tails)
    for (double p : tails)
      seeds.push_back({along.middle + t * along.range, around.middle + p * around.range, along.range, around.range});
}

std::vector<Seed> samples(const Scatterer& scatterer, const bsdf::Point& view) {
  std::map<int, std::vector<Seed>> lobes;
  const std::size_t count = averages(scatterer, view) ? samples_of_averages : samples_of_caustics;
  for (const bsdf::Sample& sample : draw(scatterer, view, count, 20031109))
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

/// Whether a function is the same at phi and -phi, by its values near the seeds.
bool is_even(const Batch& function, const bsdf::Point& view, const std::vector<Seed>& seeds) {
  constexpr std::size_t most = 48;
  std::vector<bsdf::Point> points;
  for (std::size_t k = 0; k < std::min(most, seeds.size()); ++k) {
    bsdf::Point point = view;
    const Seed& seed = seeds[k * seeds.size() / std::min(most, seeds.size())];
    point.theta_i = std::clamp(seed.theta, -1.5, 1.5);
    for (double side : {-1.0, 1.0}) {
      point.phi = side * seed.phi;
      points.push_back(point);
    }
  }
  const std::vector<glm::dvec3> values = values_at(function, points);
  for (std::size_t k = 0; k + 1 < values.size(); k += 2)
    if (!(largest(values[k] - values[k + 1]) <= 1e-4 * largest(values[k]))) return false;
  return true;
}

}  // namespace

Partition partition_for(const Scatterer& scatterer, const bsdf::Point& view) {
  Partition partition{even(-pi / 2, pi / 2, 8), even(-pi, pi, 6),
                      scatterer.sample ? samples(scatterer, view) : around_the_mirror_direction(view)};
  if (averages(scatterer, view)) partition.scales = 12;
  partition.even = is_even(scatterer.scattering, view, partition.seeds) &&
                   (!scatterer.pdf || is_even(scatterer.pdf, view, partition.seeds));
  if (!partition.even) return partition;
  partition.phi = even(0, pi, 3);
  for (Seed& seed : partition.seeds) seed.phi = std::abs(seed.phi);
  return partition;
}

}  // namespace cuticle::study::model_check
