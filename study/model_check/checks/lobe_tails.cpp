// S along theta_i at a fixed azimuth: no more humps than lobes, and no fall from a visible value to nothing within one
// step.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;

std::vector<double> profile(const Batch& function, bsdf::Point point, double phi, int steps) {
  std::vector<bsdf::Point> points;
  point.phi = phi;
  for (int i = 0; i <= steps; ++i) {
    point.theta_i = std::clamp(pi * (double(i) / steps - 0.5), -pi / 2, pi / 2);
    points.push_back(point);
  }
  std::vector<double> values;
  for (const glm::dvec3& value : values_at(function, points)) values.push_back(brightness(value));
  return values;
}

/// Local maxima below `ceiling` that stand at least a hundredth, and the errors of both values, above the valleys
/// beside them; what lies below `floor` is rounding.
std::size_t humps(const std::vector<double>& values, const std::vector<double>& errors, double floor, double ceiling) {
  std::size_t count = 0, turn = 0;
  bool rising = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double step = (rising ? 1 : -1) * (values[i] - values[turn]);
    const double largest = std::max(values[i], values[turn]);
    if (step >= 0) turn = i;
    if (-step <= 0.01 * largest + errors[i] + errors[turn] || largest <= floor) continue;
    count += rising && largest < ceiling ? 1 : 0;
    rising = !rising;
    turn = i;
  }
  return count;
}

/// The largest value that stands beside a 0, beyond the errors of both.
double cut(const std::vector<double>& values, const std::vector<double>& errors) {
  double largest = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if ((values[i] == 0) != (values[i - 1] == 0))
      largest = std::max(largest, std::max(values[i], values[i - 1]) - errors[i] - errors[i - 1]);
  return largest;
}

}  // namespace

Verdict lobe_tails(const Subject& subject, const Options& options) {
  const std::optional<Scatterer> scatterer = subject.make({Absorption::given, Roughness::usual, Tilt::given});
  if (!scatterer) return skipped("its roughness cannot be set");
  const int steps = options.quick ? 1000 : 4000;
  Worst cuts, ripples;
  for (const bsdf::Point& view : furnace_views(subject, options))
    for (double phi : {0.3, 2.9, -1.2}) {
      const std::vector<double> values = profile(scatterer->scattering, view, phi, steps);
      const double peak = *std::max_element(values.begin(), values.end());
      const std::string place = fmt::format("phi = {:.3g} deg, {}", phi * 180 / pi, where(subject, *scatterer, view));
      if (!(peak > 0)) continue;
      const std::vector<double> errors =
          averages(*scatterer, view) ? profile(scatterer->error, view, phi, steps) : std::vector<double>(values.size());
      cuts.note(cut(values, errors) / peak, place);
      ripples.note(double(humps(values, errors, 1e-9 * peak, 1e-3 * peak)), place);
    }
  Verdict verdict = judged(cuts.value, 1e-6,
                           fmt::format("cut at {:.1e} of the peak ({}); {:.0f} humps in the tails of {} lobes at {}",
                                       cuts.value, cuts.where, ripples.value, subject.lobes, ripples.where));
  if (ripples.value > double(subject.lobes)) verdict.state = State::failed;
  return verdict;
}

}  // namespace cuticle::study::model_check
