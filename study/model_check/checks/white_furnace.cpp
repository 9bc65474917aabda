// A fibre that absorbs nothing, lit evenly from everywhere: by quadrature for each viewing direction.
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

constexpr std::array<Situation, 4> white_furnace_situations = {{{Absorption::none, Roughness::usual, Tilt::given},
                                                                {Absorption::none, Roughness::narrowest, Tilt::given},
                                                                {Absorption::none, Roughness::wide, Tilt::given},
                                                                {Absorption::none, Roughness::narrow, Tilt::strong}}};
constexpr double white_furnace_tolerance = 1e-4;

struct Range {
  double least = 1e300, most = -1e300, own_error = 0;
  std::size_t unresolved = 0, unknown = 0, known = 0;
};

std::string summary(const Range& range, const std::string& place) {
  std::string text =
      fmt::format("energy {:.6f} .. {:.6f} over {} views; worst at {}", range.least, range.most, range.known, place);
  if (range.unresolved > 0) text += fmt::format("; {} not resolved to 1e-4", range.unresolved);
  if (range.own_error > 0) text += fmt::format("; errors that S reports add up to {:.1e}", range.own_error);
  if (range.unknown > 0) text += fmt::format("; {} views left out where they exceed {}", range.unknown, most_own_error);
  return text;
}

}  // namespace

Verdict white_furnace(const Subject& subject, const Options& options) {
  Worst worst;
  Range range;
  const std::vector<bsdf::Point> views = furnace_views(subject, options);
  const std::vector<Scatterer> all =
      scatterers(subject, std::span(white_furnace_situations).first(options.quick ? 2 : 4));
  if (all.empty()) return skipped("it cannot be made free of absorption");
  for (const Scatterer& scatterer : all)
    for (const bsdf::Point& view : views) {
      const SphereIntegral energy = scattered_energy(scatterer, view, white_furnace_tolerance, most_own_error);
      if (energy.own_error > most_own_error) {
        ++range.unknown;
        continue;
      }
      const double value = largest(energy.value);
      ++range.known;
      range.least = std::min(range.least, value);
      range.most = std::max(range.most, value);
      range.unresolved += energy.converged ? 0 : 1;
      range.own_error = std::max(range.own_error, energy.own_error);
      const double excess = subject.complete ? std::abs(value - 1) : value - 1;
      worst.note(excess - energy.own_error, where(subject, scatterer, view));
    }
  if (range.known == 0) return skipped("S reports errors too large for any view");
  const double allowed = 5e-4 + 100 * subject.rounding;
  return judged(std::max(worst.value, 0.0), allowed, summary(range, worst.where));
}

}  // namespace cuticle::study::model_check
