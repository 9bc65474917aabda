// Reciprocity of the far field, as a report: by how much S(a -> b) and S(b -> a) differ. The separable models of the
// literature have S itself symmetric; light that follows Helmholtz's law, S times the area seen from the viewer, which
// is cos(theta_o) and, for an ellipse, its width (docs/conventions.md: no cosine belongs to S). The two agree in the
// mirror direction of a circular fibre, and either is accepted.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "core/random.h"
#include "study/model_check/checks/checks.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;

/// Directions at random, theta_i within 30 degrees of the mirror direction, and the same exchanged.
std::vector<bsdf::Point> pairs(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<bsdf::Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double theta_o = std::asin(2 * random.next_unit() - 1);
    const double theta_i = std::clamp(-theta_o + (random.next_unit() - 0.5) * pi / 3, -pi / 2, pi / 2);
    const double phi = 2 * pi * (random.next_unit() - 0.5);
    points.push_back({.theta_i = theta_i, .theta_o = theta_o, .phi = phi});
    points.push_back({.theta_i = theta_o, .theta_o = theta_i, .phi = -phi, .phi_o = -phi});
  }
  return points;
}

struct Difference {
  double median = 0, worst = 0;
  std::string_view form;
};

/// S, or S times the area seen, at points with its errors.
struct Values {
  std::vector<glm::dvec3> value, error;
};

Values values_of(const Scatterer& scatterer, const std::vector<bsdf::Point>& points) {
  Values values{values_at(scatterer.scattering, points), std::vector<glm::dvec3>(points.size())};
  if (scatterer.error) scatterer.error(points, values.error);
  return values;
}

/// Seen from the viewer, for each unit of length.
double area_seen(double aspect, const bsdf::Point& point) {
  return std::cos(point.theta_o) * std::hypot(std::sin(point.phi_o), aspect * std::cos(point.phi_o));
}

Values as_flux(Values values, double aspect, const std::vector<bsdf::Point>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    values.value[i] *= area_seen(aspect, points[i]);
    values.error[i] *= area_seen(aspect, points[i]);
  }
  return values;
}

/// |a - b| / max(a, b) beyond the errors that the model reports, over the pairs in which the larger is at least a
/// thousandth of the largest value.
Difference differences(const Values& values, std::string_view form) {
  double peak = 0;
  for (const glm::dvec3& value : values.value) peak = std::max(peak, brightness(value));
  std::vector<double> found;
  for (std::size_t i = 0; i + 1 < values.value.size(); i += 2) {
    const double a = brightness(values.value[i]), b = brightness(values.value[i + 1]);
    const double beyond = std::abs(a - b) - brightness(values.error[i]) - brightness(values.error[i + 1]);
    if (std::max(a, b) > 1e-3 * peak) found.push_back(std::max(beyond, 0.0) / std::max(a, b));
  }
  if (found.empty()) return {.form = form};
  std::sort(found.begin(), found.end());
  return {found[found.size() / 2], found.back(), form};
}

/// Of the two forms the one that comes nearer.
Difference nearer(const Scatterer& scatterer, const std::vector<bsdf::Point>& points) {
  const Values values = values_of(scatterer, points);
  const std::string_view seen = scatterer.aspect == 1 ? "S cos(theta_o)" : "S cos(theta_o) width(phi_o)";
  const Difference plain = differences(values, "S"),
                   flux = differences(as_flux(values, scatterer.aspect, points), seen);
  return flux.worst < plain.worst ? flux : plain;
}

}  // namespace

Verdict reciprocity(const Subject& subject, const Options& options) {
  if (subject.near_field) return skipped("the offset of the light is not that of the view in the near field");
  const std::vector<bsdf::Point> points = pairs(options.quick ? 1000 : 10000, options.seed);
  const std::optional<Scatterer> untilted = subject.make({Absorption::given, Roughness::given, Tilt::none});
  const std::optional<Scatterer> tilted = subject.make({Absorption::given, Roughness::given, Tilt::given});
  const Scatterer& scatterer = untilted ? *untilted : *tilted;
  const Difference found = nearer(scatterer, points);
  std::string words = fmt::format("{} differs by {:.2e} at most, {:.2e} in the middle ({})", found.form, found.worst,
                                  found.median, scatterer.label);
  if (untilted && tilted) words += fmt::format("; with its tilt {:.2e} at most", nearer(*tilted, points).worst);
  return judged(found.worst, 1e-6 + 1e4 * subject.rounding, words);
}

}  // namespace cuticle::study::model_check
