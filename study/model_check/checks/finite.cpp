// A seeded search over the whole domain of points and parameters: random values, corners, and the neighbours of corners
// in floating point.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/core.h>

#include "core/random.h"
#include "study/model_check/checks/checks.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;
constexpr std::size_t points_per_setting = 48, points_of_others = 8;

/// One of the corners, a neighbour of one, or any value in between.
double pick(RandomStream& random, std::span<const double> corners, double low, double high) {
  const double kind = random.next_unit(), place = random.next_unit();
  if (kind < 0.4) return low + (high - low) * place;
  const double corner = corners[std::size_t(place * double(corners.size()))];
  if (kind < 0.7) return corner;
  const double aim = random.next_unit() < 0.5 ? low : high;
  return kind < 0.85 ? std::nextafter(corner, aim) : double(std::nextafter(float(corner), float(aim)));
}

double within(double value, double limit) { return std::clamp(value, -limit, limit); }

bsdf::Point pick_point(RandomStream& random) {
  constexpr double right = pi / 2;
  constexpr std::array<double, 8> angles = {-right, -right * (1 - 1e-5), -0.8, 0, 1e-7,
                                            0.8179, right * (1 - 1e-5),  right};
  constexpr std::array<double, 7> turns = {-pi, -pi / 2, 0, 1e-7, 0.325, pi / 2, pi};
  constexpr std::array<double, 6> offsets = {-1, -0.999999, 0, 0.7297, 0.999999, 1};
  bsdf::Point point;
  point.theta_i = within(pick(random, angles, -right, right), right);
  point.theta_o = random.next_unit() < 0.3 ? -point.theta_i : within(pick(random, angles, -right, right), right);
  point.theta_d = 0.5 * (point.theta_o - point.theta_i);
  point.phi = pick(random, turns, -pi, pi);
  point.h = within(pick(random, offsets, -1, 1), 1);
  point.phi_o = pick(random, turns, -pi, pi);
  return point;
}

bsdf::SampleQuery pick_query(RandomStream& random) {
  constexpr std::array<double, 4> ends = {0, 0x1p-53, 0.5, 1 - 0x1p-53};
  const bsdf::Point point = pick_point(random);
  bsdf::SampleQuery query{.theta_o = point.theta_o, .phi_o = point.phi_o, .h = point.h};
  for (double& u : query.u) u = std::clamp(pick(random, ends, 0, 1), 0.0, 1 - 0x1p-53);
  return query;
}

struct Search {
  std::size_t tried = 0, bad = 0;
  std::string first;
  void note(bool good, const std::string& words) {
    ++tried;
    if (good) return;
    if (bad++ == 0) first = words;
  }
};

bool sound(const glm::dvec3& value) {
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(value[c]) || value[c] < 0) return false;
  return true;
}

std::string described(const bsdf::Point& p) {
  return fmt::format("theta_i {:.17g}, theta_o {:.17g}, theta_d {:.17g}, phi {:.17g}, h {:.17g}, phi_o {:.17g}",
                     p.theta_i, p.theta_o, p.theta_d, p.phi, p.h, p.phi_o);
}

void hunt(const Batch& batch, const std::string& name, const Scatterer& scatterer, std::span<const bsdf::Point> points,
          Search& search) {
  if (!batch) return;
  const std::vector<glm::dvec3> values = values_at(batch, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    search.note(sound(values[i]),
                fmt::format("{} = {} at {} rad ({})", name, values[i].x, described(points[i]), scatterer.label));
}

void hunt_samples(const Scatterer& scatterer, RandomStream& random, Search& search) {
  if (!scatterer.sample) return;
  std::vector<bsdf::SampleQuery> queries(points_per_setting);
  for (bsdf::SampleQuery& query : queries) query = pick_query(random);
  std::vector<bsdf::Sample> samples(queries.size());
  scatterer.sample(queries, samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bsdf::Sample& s = samples[i];
    const bool inside = std::abs(s.theta_i) <= pi / 2 * (1 + 1e-6) && std::isfinite(s.phi);
    search.note(inside && std::isfinite(s.pdf) && s.pdf >= 0 && sound(s.weight),
                fmt::format("a sample of theta_i {}, phi {}, pdf {}, weight {} for theta_o {:.17g}, h {:.17g} ({})",
                            s.theta_i, s.phi, s.pdf, s.weight.x, queries[i].theta_o, queries[i].h, scatterer.label));
  }
}

void hunt_all(const Scatterer& scatterer, RandomStream& random, Search& search) {
  std::vector<bsdf::Point> points(points_per_setting);
  for (bsdf::Point& point : points) point = pick_point(random);
  hunt(scatterer.scattering, "S", scatterer, points, search);
  hunt(scatterer.pdf, "pdf", scatterer, points, search);
  hunt(scatterer.albedo, "albedo", scatterer, std::span(points).first(2), search);
  for (const auto& [name, batch] : scatterer.others)
    hunt(batch, name, scatterer, std::span(points).first(points_of_others), search);
  hunt_samples(scatterer, random, search);
}

}  // namespace

Verdict finite(const Subject& subject, const Options& options) {
  if (subject.searched) return skipped("the first variant was searched over all parameters");
  RandomStream random(options.seed, 9);
  Search search;
  const std::uint64_t settings = options.quick ? 40 : 400;
  for (std::uint64_t k = 0; k < settings; ++k) {
    if (subject.vary) {
      hunt_all(subject.vary(options.seed * 1000003 + k), random, search);
    } else if (const auto scatterer = subject.make({})) {
      hunt_all(*scatterer, random, search);
    }
  }
  const std::string words = search.bad == 0
                                ? fmt::format("{} values", search.tried)
                                : fmt::format("{} of {} values; first {}", search.bad, search.tried, search.first);
  return judged(double(search.bad), 0, words);
}

}  // namespace cuticle::study::model_check
