// The integral of S over phi in the mirror direction, as the inclination grows: where caustics form, merge and vanish,
// the energy may not jump.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;
constexpr double half_width = 1e-7;  // of the ring around the mirror direction [rad]
constexpr double steepest = 80;      // [deg]

/// Energy, and what the model says of its error.
struct Ring {
  double value = 0, own_error = 0;
};

Ring ring_energy(const Scatterer& scatterer, double theta_o, double h) {
  Partition ring{{-theta_o - half_width, -theta_o + half_width}, {}};
  for (int k = 0; k <= 16; ++k) ring.phi.push_back(pi * (k / 8.0 - 1));
  const double scale = 2 * half_width * std::cos(theta_o);
  const bsdf::Point view{.theta_o = theta_o, .h = h};
  const SphereIntegral energy =
      integrate_sphere(scatterer.scattering, view, ring, {2e-5 * scale, 40000, scatterer.error});
  return {brightness(energy.value) / scale, energy.own_error / scale};
}

struct Step {
  double low = 0, high = 0;
  Ring below, above;
  double jump() const {
    const double change = std::abs(above.value - below.value) - above.own_error - below.own_error;
    return std::max(change, 0.0) / std::max({std::abs(above.value), std::abs(below.value), 1e-3});
  }
};

/// What remains of a change when its step is halved again and again on the side of the larger change.
Step narrowed(const Scatterer& scatterer, Step step, double h) {
  for (int k = 0; k < 18; ++k) {
    const double middle = 0.5 * (step.low + step.high);
    const Ring ring = ring_energy(scatterer, middle, h);
    const Step low{step.low, middle, step.below, ring}, high{middle, step.high, ring, step.above};
    step = low.jump() > high.jump() ? low : high;
  }
  return step;
}

std::vector<Step> sweep(const Scatterer& scatterer, double h, int parts) {
  std::vector<Step> steps;
  Ring before = ring_energy(scatterer, 0, h);
  for (int k = 0; k < parts; ++k) {
    const double low = steepest * degree * k / parts, high = steepest * degree * (k + 1) / parts;
    const Ring ring = ring_energy(scatterer, high, h);
    steps.push_back({low, high, before, ring});
    before = ring;
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.jump() > b.jump(); });
  return steps;
}

}  // namespace

Verdict caustic_continuity(const Subject& subject, const Options& options) {
  const std::optional<Scatterer> scatterer = subject.make({Absorption::given, Roughness::usual, Tilt::none});
  if (!scatterer) return skipped("its roughness cannot be set");
  Worst worst;
  constexpr double h = 0.4;
  const std::vector<Step> steps = sweep(*scatterer, h, options.quick ? 20 : 40);
  for (std::size_t k = 0; k < (options.quick ? 1u : 3u); ++k) {
    const Step step = narrowed(*scatterer, steps[k], h);
    worst.note(step.jump(), fmt::format("theta_d = {:.4f} deg ({})", step.low / degree, scatterer->label));
  }
  return judged(worst.value, 1e-3 + 1e3 * subject.rounding,
                fmt::format("largest jump {:.1e} of the energy over phi, at {}", worst.value, worst.where));
}

}  // namespace cuticle::study::model_check
