#include "study/oracle/dielectric_cylinder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "study/oracle/optics.h"

namespace cuticle::study::oracle {
namespace {

using glm::dvec3;
using std::numbers::pi;

/// A ray on the surface, with a unit vector for its direction.
struct Ray {
  dvec3 position, direction;
};

dvec3 surface_normal(dvec3 position) { return glm::normalize(dvec3(position.x, position.y, 0)); }

/// The ray that meets the cylinder at offset h, travelling toward -x at inclination theta.
Ray incoming(double theta, double h) {
  return {dvec3(std::sqrt(1 - h * h), h, 0), dvec3(-std::cos(theta), 0, std::sin(theta))};
}

/// Length of the straight way through the inside to the surface again.
double inner_path(const Ray& ray) {
  const dvec3 d = ray.direction;
  return -2 * (ray.position.x * d.x + ray.position.y * d.y) / (d.x * d.x + d.y * d.y);
}

double facing_cosine(const Ray& ray) { return std::abs(glm::dot(ray.direction, surface_normal(ray.position))); }

/// Across the inside: moves to the far surface and takes away what is absorbed on the way.
Ray cross(const DielectricCylinder& cylinder, const Ray& ray, dvec3& energy) {
  const double path = inner_path(ray);
  energy *= glm::exp(-cylinder.sigma_a * path);
  return {ray.position + path * ray.direction, ray.direction};
}

Exit leave(dvec3 direction, dvec3 energy) { return {std::atan2(direction.y, direction.x), direction.z, energy}; }

double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

/// Adds `energy`, spread evenly from azimuth `first` over `width` (signed) radians, to bins over the circle.
void spread(std::vector<dvec3>& bins, double first, double width, dvec3 energy) {
  const double begin = (std::min(first, first + width) + pi) / (2 * pi) * double(bins.size());
  const double size = std::abs(width) / (2 * pi) * double(bins.size());
  const std::int64_t count = std::int64_t(bins.size());
  for (std::int64_t cell = std::int64_t(std::floor(begin));
       double(cell) < begin + size || cell == std::int64_t(std::floor(begin)); ++cell) {
    const double overlap = std::min(begin + size, double(cell + 1)) - std::max(begin, double(cell));
    bins[std::size_t(((cell % count) + count) % count)] += energy * (size > 0 ? overlap / size : 1.0);
  }
}

/// Offsets from edge to edge for t in [0, 1], closer together where grazing makes the energy change fast. A ray at |h|
/// = 1 itself never enters.
double offset_at(double t) { return (1 - 1e-14) * std::sin(pi * (t - 0.5)); }

double uniform(std::mt19937_64& generator) { return double(generator() >> 11) * 0x1p-53; }

/// One random walk: the order at which it leaves (orders or more: not counted), with what absorption left of it.
std::pair<int, dvec3> walk(const DielectricCylinder& cylinder, double theta, int orders, std::mt19937_64& generator) {
  dvec3 energy(1);
  Ray ray = incoming(theta, 2 * uniform(generator) - 1);
  if (uniform(generator) < reflectance(facing_cosine(ray), 1, cylinder.eta)) return {0, energy};
  ray.direction = refract(ray.direction, surface_normal(ray.position), 1 / cylinder.eta);
  for (int order = 1; order < orders; ++order) {
    ray = cross(cylinder, ray, energy);
    if (uniform(generator) >= reflectance(facing_cosine(ray), cylinder.eta, 1)) return {order, energy};
    ray.direction = reflect(ray.direction, surface_normal(ray.position));
  }
  return {orders, energy};
}

}  // namespace

Exit follow(const DielectricCylinder& cylinder, double theta, double h, int lobe) {
  Ray ray = incoming(theta, h);
  const double outside = reflectance(facing_cosine(ray), 1, cylinder.eta);
  if (lobe == 0) return leave(reflect(ray.direction, surface_normal(ray.position)), dvec3(outside));
  dvec3 energy(1 - outside);
  ray.direction = refract(ray.direction, surface_normal(ray.position), 1 / cylinder.eta);
  for (int crossing = 1;; ++crossing) {
    ray = cross(cylinder, ray, energy);
    const double inside = reflectance(facing_cosine(ray), cylinder.eta, 1);
    const dvec3 normal = surface_normal(ray.position);
    if (crossing == lobe) return leave(refract(ray.direction, normal, cylinder.eta), energy * (1 - inside));
    energy *= inside;
    ray.direction = reflect(ray.direction, normal);
  }
}

std::vector<dvec3> azimuthal_bins(const DielectricCylinder& cylinder, double theta_d, int lobe, int bins, int offsets) {
  std::vector<dvec3> sums(std::size_t(bins), dvec3(0));
  double h = offset_at(0);
  Exit before = follow(cylinder, theta_d, h, lobe);
  for (int i = 1; i <= offsets; ++i) {
    const double next = offset_at(double(i) / offsets);
    const Exit after = follow(cylinder, theta_d, next, lobe);
    spread(sums, before.phi, wrapped(after.phi - before.phi), (before.energy + after.energy) * ((next - h) / 4));
    before = after;
    h = next;
  }
  for (dvec3& sum : sums) sum /= 2 * pi / bins;
  return sums;
}

dvec3 lobe_energy(const DielectricCylinder& cylinder, double theta_d, int lobe, int offsets) {
  dvec3 sum(0);
  for (int i = 0; i < offsets; ++i) {
    const double width = offset_at((i + 1.0) / offsets) - offset_at(double(i) / offsets);
    sum += follow(cylinder, theta_d, offset_at((i + 0.5) / offsets), lobe).energy * (width / 2);
  }
  return sum;
}

MonteCarloEnergy random_walks(const DielectricCylinder& cylinder, double theta_d, int orders, std::int64_t walks,
                              std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<dvec3> sums(std::size_t(orders), dvec3(0)), squares = sums;
  for (std::int64_t i = 0; i < walks; ++i) {
    const auto [order, energy] = walk(cylinder, theta_d, orders, generator);
    if (order >= orders) continue;
    sums[std::size_t(order)] += energy;
    squares[std::size_t(order)] += energy * energy;
  }
  MonteCarloEnergy result;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const dvec3 mean = sums[i] / double(walks);
    result.mean.push_back(mean);
    result.standard_error.push_back(glm::sqrt((squares[i] / double(walks) - mean * mean) / double(walks)));
  }
  return result;
}

}  // namespace cuticle::study::oracle
