#include "study/oracle/rough_fibre.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace cuticle::study::oracle {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr int most_events = 1000000;  ///< of scattering in the medulla during one crossing
constexpr int most_meetings = 1000;   ///< with the surface at one place

struct FibreRay {
  dvec3 position, direction;
};

/// The form whose value is 1 on the surface: x^2 + y^2 / aspect^2.
double form(const RoughFibre& fibre, dvec3 a, dvec3 b) { return a.x * b.x + a.y * b.y / (fibre.aspect * fibre.aspect); }

dvec3 outward_normal(const RoughFibre& fibre, dvec3 position) {
  return glm::normalize(dvec3(position.x, position.y / (fibre.aspect * fibre.aspect), 0));
}

/// Distances at which the ray passes the cross-section scaled by `scale`; none where it misses.
std::optional<std::pair<double, double>> passage(const RoughFibre& fibre, const FibreRay& ray, double scale) {
  const double a = form(fibre, ray.direction, ray.direction), b = form(fibre, ray.position, ray.direction);
  const double discriminant = b * b - a * (form(fibre, ray.position, ray.position) - scale * scale);
  if (discriminant <= 0 || a < 1e-200) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return std::pair((-b - root) / a, (-b + root) / a);
}

/// The ray from the viewer where it meets the surface.
FibreRay incoming(const RoughFibre& fibre, const Viewer& viewer, double h) {
  const double c = std::cos(viewer.phi_o), s = std::sin(viewer.phi_o);
  const double half_width = std::hypot(s, fibre.aspect * c);
  const dvec3 offset = h * half_width * dvec3(-s, c, 0);
  const FibreRay inward{offset, dvec3(-c, -s, 0)};
  const auto reach = passage(fibre, inward, 1);
  const double cosine = std::cos(viewer.theta_o);
  return {offset + (reach ? reach->first : 0.0) * inward.direction,
          dvec3(-cosine * c, -cosine * s, -std::sin(viewer.theta_o))};
}

/// Two unit vectors that make a right-handed frame with `z`.
std::pair<dvec3, dvec3> frame_of(dvec3 z) {
  const dvec3 helper = std::abs(z.z) < 0.7 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
  const dvec3 x = glm::normalize(glm::cross(helper, z));
  return {x, glm::cross(z, x)};
}

dvec3 scattered(dvec3 direction, double g, RandomStream& random) {
  const double u = 2 * random.next_unit() - 1, turn = 2 * pi * random.next_unit();
  const double share = (1 - g * g) / (1 + g * u);
  const double cosine = std::abs(g) < 1e-6 ? u : std::clamp((1 + g * g - share * share) / (2 * g), -1.0, 1.0);
  const double sine = std::sqrt(1 - cosine * cosine);
  const auto [x, y] = frame_of(direction);
  return sine * std::cos(turn) * x + sine * std::sin(turn) * y + cosine * direction;
}

/// The part [begin, end] of the way ahead that lies in the medulla; empty where begin = end.
std::pair<double, double> way_in_medulla(const RoughFibre& fibre, const FibreRay& ray, double end) {
  if (fibre.medulla.ratio <= 0) return {end, end};
  const auto inner = passage(fibre, ray, fibre.medulla.ratio);
  if (!inner || inner->second <= 0) return {end, end};
  return {std::clamp(inner->first, 0.0, end), std::clamp(inner->second, 0.0, end)};
}

void absorb(const RoughFibre& fibre, double in_cortex, double in_medulla, dvec3& energy) {
  energy *= glm::exp(-fibre.sigma_a * in_cortex - fibre.medulla.absorption * in_medulla);
}

/// Up to the next scattering in the medulla (true) or to the surface (false), less what is absorbed on the way.
bool advance(const RoughFibre& fibre, FibreRay& ray, dvec3& energy, RandomStream& random) {
  const auto reach = passage(fibre, ray, 1);
  const double end = reach ? std::max(0.0, reach->second) : 0;
  const auto [begin, leave] = way_in_medulla(fibre, ray, end);
  const double free = fibre.medulla.scattering > 0 && leave > begin
                          ? -std::log(1 - random.next_unit()) / fibre.medulla.scattering
                          : std::numeric_limits<double>::infinity();
  const bool scatters = begin + free < leave;
  const double inside = scatters ? free : leave - begin;
  absorb(fibre, scatters ? begin : end - inside, inside, energy);
  ray.position += (scatters ? begin + free : end) * ray.direction;
  if (scatters) ray.direction = scattered(ray.direction, fibre.medulla.anisotropy, random);
  return scatters;
}

/// From surface to surface.
void cross(const RoughFibre& fibre, FibreRay& ray, dvec3& energy, RandomStream& random) {
  for (int event = 0; event < most_events; ++event)
    if (!advance(fibre, ray, energy, random)) return;
  energy = dvec3(0);
}

/// One meeting with facets around `normal`, which points to the ray's side.
Meeting meet_facets(const RoughFibre& fibre, dvec3 normal, dvec3 direction, bool inside, RandomStream& random) {
  const auto [x, y] = frame_of(normal);
  const dvec3 local(glm::dot(direction, x), glm::dot(direction, y), glm::dot(direction, normal));
  const double above = inside ? fibre.eta : 1, below = inside ? 1 : fibre.eta;
  Meeting meeting = meet_surface(fibre.surface, fibre.blocked, local, above, below, random);
  const dvec3 d = meeting.direction;
  meeting.direction = d.x * x + d.y * y + d.z * normal;
  return meeting;
}

/// Meets the surface from one side until the ray is free on one side. A scale that does not face the ray, or that sends
/// it into the surface, stops it; where light is followed, the untilted surface takes it up.
void meet_fibre(const RoughFibre& fibre, FibreRay& ray, bool& inside, dvec3& energy, RandomStream& random) {
  const dvec3 outward = outward_normal(fibre, ray.position);
  const dvec3 scale = std::cos(fibre.tilt) * outward - std::sin(fibre.tilt) * dvec3(0, 0, 1);
  dvec3 facing = scale;
  for (int count = 0; count < most_meetings; ++count) {
    const double side = inside ? -1 : 1;
    if (side * glm::dot(ray.direction, facing) >= 0) {
      if (fibre.blocked == Blocked::lost) break;
      facing = outward;
    }
    const Meeting meeting = meet_facets(fibre, side * facing, ray.direction, inside, random);
    ray.direction = meeting.direction;
    energy *= meeting.energy;
    if (meeting.below) inside = !inside;
    const bool is_free = (inside ? -1 : 1) * glm::dot(ray.direction, outward) > 0;
    if (is_free || energy == dvec3(0)) return;
    if (fibre.blocked == Blocked::lost) break;
    facing = outward;
  }
  energy = dvec3(0);
}

struct Sums {
  dvec3 sum{0}, squares{0};
  void add(dvec3 energy) {
    sum += energy;
    squares += energy * energy;
  }
  Estimate estimate(double walks, double per) const {
    const dvec3 mean = sum / walks;
    return {mean / per, glm::sqrt(glm::max(squares / walks - mean * mean, dvec3(0)) / walks) / per};
  }
};

int bin_of(double value, double lowest, double range, int bins) {
  return std::clamp(int((value - lowest) / range * bins), 0, bins - 1);
}

/// Solid angle of a bin.
double bin_size(const DirectionBins& bins, int theta) {
  const double step = pi / bins.thetas, low = theta * step - pi / 2;
  return (std::sin(low + step) - std::sin(low)) * 2 * pi / bins.phis;
}

OrderScattering estimates(const std::vector<Sums>& cells, const Sums& all, const DirectionBins& bins, double walks) {
  OrderScattering result{all.estimate(walks, 1), {}};
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    result.density.push_back(cells[cell].estimate(walks, bin_size(bins, int(cell) / bins.phis)));
  return result;
}

}  // namespace

Departure walk(const RoughFibre& fibre, const Viewer& viewer, int crossings, RandomStream& random) {
  const double h = viewer.h ? *viewer.h : 2 * random.next_unit() - 1;
  FibreRay ray = incoming(fibre, viewer, h);
  Departure end{0, 0, dvec3(1), 0};
  bool inside = false;
  meet_fibre(fibre, ray, inside, end.energy, random);
  while (inside && end.order < crossings && end.energy != dvec3(0)) {
    cross(fibre, ray, end.energy, random);
    ++end.order;
    meet_fibre(fibre, ray, inside, end.energy, random);
  }
  if (inside) end.energy = dvec3(0);
  end.theta_i = std::asin(std::clamp(ray.direction.z, -1.0, 1.0));
  end.phi = std::remainder(viewer.phi_o - std::atan2(ray.direction.y, ray.direction.x), 2 * pi);
  return end;
}

std::vector<OrderScattering> scattering_of(const RoughFibre& fibre, const Viewer& viewer, const DirectionBins& bins,
                                           int orders, std::int64_t walks, std::uint64_t seed) {
  std::vector<Sums> all(static_cast<std::size_t>(orders));
  std::vector<std::vector<Sums>> cells(all.size(), std::vector<Sums>(std::size_t(bins.thetas * bins.phis)));
  for (std::int64_t n = 0; n < walks; ++n) {
    RandomStream random(seed, std::uint64_t(n));
    const Departure end = walk(fibre, viewer, orders, random);
    if (end.order >= orders || end.energy == dvec3(0)) continue;
    const int cell =
        bin_of(end.theta_i, -pi / 2, pi, bins.thetas) * bins.phis + bin_of(end.phi, -pi, 2 * pi, bins.phis);
    all[std::size_t(end.order)].add(end.energy);
    cells[std::size_t(end.order)][std::size_t(cell)].add(end.energy);
  }
  std::vector<OrderScattering> result;
  for (std::size_t order = 0; order < all.size(); ++order)
    result.push_back(estimates(cells[order], all[order], bins, double(walks)));
  return result;
}

}  // namespace cuticle::study::oracle
