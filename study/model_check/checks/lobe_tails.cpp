// S along theta_i at a fixed azimuth: no more humps than lobes, and no fall from a visible value to nothing within one
// step.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include <cuticle/study/model_check/checks/checks.h>

namespace cuticle::study::model_check {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int steps = 4000;

std::vector<double> profile(const Scatterer& scatterer, bsdf::Point point, double phi) {
  std::vector<bsdf::Point> points;
  point.phi = phi;
  for (int i = 0; i <= steps; ++i) {
    point.theta_i = std::clamp(pi * (double(i) / steps - 0.5), -pi / 2, pi / 2);
    points.push_back(point);
  }
  std::vector<double> values;
  for (const glm::dvec3& value : values_at(scatterer.scattering, points)) values.push_back(brightness(value));
  return values;
}

/// Local maxima below `ceiling` that stand at least a hundredth above the valleys beside them; what lies below `floor`
/// is rounding.
std::size_t humps(const std::vector<double>& values, double floor, double ceiling) {
  std::size_t count = 0;
  bool rising = true;
  double turn = values.front();
  for (double value : values) {
    if (rising) {
      turn = std::max(turn, value);
      if (value >= 0.99 * turn || turn <= floor) continue;
      count += turn < ceiling ? 1 : 0;
    } else {
      turn = std::min(turn, value);
      if (value <= 1.01 * turn + floor) continue;
    }
    rising = !rising;
    turn = value;
  }
  return count;
}

/// The largest value that stands beside a 0.
double cut(const std::vector<double>& values) {
  double largest = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if ((values[i] == 0) != (values[i - 1] == 0)) largest = std::max(largest, std::max(values[i], values[i - 1]));
  return largest;
}

}  // namespace

Verdict lobe_tails(const Subject& subject, const Options& options) {
  const std::optional<Scatterer> scatterer = subject.make({Absorption::given, Roughness::usual, Tilt::given});
  if (!scatterer) return skipped("its roughness cannot be set");
  Worst cuts, ripples;
  for (const bsdf::Point& view : furnace_views(subject, options))
    for (double phi : {0.3, 2.9, -1.2}) {
      const std::vector<double> values = profile(*scatterer, view, phi);
      const double peak = *std::max_element(values.begin(), values.end());
      const std::string place = fmt::format("phi = {:.3g} deg, {}", phi * 180 / pi, where(subject, *scatterer, view));
      if (!(peak > 0)) continue;
      cuts.note(cut(values) / peak, place);
      ripples.note(double(humps(values, 1e-9 * peak, 1e-3 * peak)), place);
    }
  Verdict verdict = judged(cuts.value, 1e-6,
                           fmt::format("cut at {:.1e} of the peak ({}); {:.0f} humps in the tails of {} lobes at {}",
                                       cuts.value, cuts.where, ripples.value, subject.lobes, ripples.where));
  if (ripples.value > double(subject.lobes)) verdict.state = State::failed;
  return verdict;
}

}  // namespace cuticle::study::model_check
