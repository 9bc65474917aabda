// Helmholtz reciprocity of the far field, as a report: by how much S(a -> b) and S(b -> a) differ.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include <cuticle/core/random.h>
#include <cuticle/study/model_check/checks/checks.h>

namespace cuticle::study::model_check {
namespace {

constexpr double pi = std::numbers::pi;

/// Directions at random, theta_i within 30 degrees of the mirror direction, and the same exchanged.
std::vector<bsdf::Point> pairs(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<bsdf::Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double theta_o = std::asin(2 * random.next_unit() - 1);
    const double theta_i = std::clamp(-theta_o + (random.next_unit() - 0.5) * pi / 3, -pi / 2, pi / 2);
    const double phi = 2 * pi * (random.next_unit() - 0.5);
    points.push_back({.theta_i = theta_i, .theta_o = theta_o, .phi = phi});
    points.push_back({.theta_i = theta_o, .theta_o = theta_i, .phi = -phi});
  }
  return points;
}

struct Difference {
  double median = 0, worst = 0;
};

/// |a - b| / max(a, b) over the pairs in which S is at least a thousandth of the largest value.
Difference differences(const Scatterer& scatterer, const std::vector<bsdf::Point>& points) {
  const std::vector<glm::dvec3> values = values_at(scatterer.scattering, points);
  double peak = 0;
  for (const glm::dvec3& value : values) peak = std::max(peak, brightness(value));
  std::vector<double> found;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    const double a = brightness(values[i]), b = brightness(values[i + 1]);
    if (std::max(a, b) > 1e-3 * peak) found.push_back(std::abs(a - b) / std::max(a, b));
  }
  if (found.empty()) return {};
  std::sort(found.begin(), found.end());
  return {found[found.size() / 2], found.back()};
}

}  // namespace

Verdict reciprocity(const Subject& subject, const Options& options) {
  if (subject.near_field) return skipped("the offset of the light is not that of the view in the near field");
  const std::vector<bsdf::Point> points = pairs(options.quick ? 1000 : 10000, options.seed);
  const std::optional<Scatterer> untilted = subject.make({Absorption::given, Roughness::given, Tilt::none});
  const std::optional<Scatterer> tilted = subject.make({Absorption::given, Roughness::given, Tilt::given});
  const Scatterer& scatterer = untilted ? *untilted : *tilted;
  const Difference found = differences(scatterer, points);
  std::string words =
      fmt::format("differs by {:.2e} at most, {:.2e} in the middle ({})", found.worst, found.median, scatterer.label);
  if (untilted && tilted) words += fmt::format("; with its tilt {:.2e} at most", differences(*tilted, points).worst);
  return judged(found.worst, 1e-6 + 1e4 * subject.rounding, words);
}

}  // namespace cuticle::study::model_check
