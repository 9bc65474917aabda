// The energy that a coloured fibre scatters, by quadrature of S: against the model's own albedo, and where the lobes
// are narrow and untilted against the mean attenuation of a dielectric cylinder.
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/mean_attenuation.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

constexpr std::array<Situation, 3> absorbing_furnace_situations = {
    {{Absorption::coloured, Roughness::usual, Tilt::given},
     {Absorption::coloured, Roughness::wide, Tilt::given},
     {Absorption::given, Roughness::narrow, Tilt::given}}};
constexpr Situation as_a_cylinder = {Absorption::coloured, Roughness::narrowest, Tilt::none};
constexpr double absorbing_furnace_tolerance = 3e-4;
constexpr double steepest_view = 1.4;  // [rad]; beyond, the width of even the narrowest lobe changes the energy

void against_albedo(const Subject& subject, const Options& options, Worst& worst) {
  for (const Scatterer& scatterer :
       scatterers(subject, std::span(absorbing_furnace_situations).first(options.quick ? 1 : 3))) {
    if (!scatterer.albedo) continue;
    for (const bsdf::Point& view : furnace_views(subject, options)) {
      const SphereIntegral energy = scattered_energy(scatterer, view, absorbing_furnace_tolerance, most_own_error);
      if (energy.own_error > most_own_error) continue;
      const glm::dvec3 difference = energy.value - value_at(scatterer.albedo, view);
      worst.note(std::max(largest(difference) - energy.own_error, 0.0),
                 "the albedo at " + where(subject, scatterer, view));
    }
  }
}

void against_cylinder(const Subject& subject, const Options& options, Worst& worst) {
  const std::optional<Scatterer> scatterer = subject.make(as_a_cylinder);
  if (!scatterer || !scatterer->cylinder) return;
  for (const bsdf::Point& view : furnace_views(subject, options)) {
    if (std::abs(view.theta_o) > steepest_view) continue;
    const Cylinder& cylinder = *scatterer->cylinder;
    const glm::dvec3 truth =
        subject.near_field ? attenuation_at(cylinder, view.theta_o, view.h) : mean_attenuation(cylinder, view.theta_o);
    const SphereIntegral energy = scattered_energy(*scatterer, view, absorbing_furnace_tolerance, most_own_error);
    if (energy.own_error > most_own_error) continue;
    worst.note(std::max(largest(energy.value - truth) - energy.own_error, 0.0),
               "a dielectric cylinder at " + where(subject, *scatterer, view));
  }
}

}  // namespace

Verdict absorbing_furnace(const Subject& subject, const Options& options) {
  Worst albedo, cylinder;
  against_albedo(subject, options, albedo);
  against_cylinder(subject, options, cylinder);
  if (albedo.where.empty() && cylinder.where.empty()) return skipped("it names neither an albedo nor a dielectric");
  std::string words;
  for (const Worst* worst : {&albedo, &cylinder})
    if (!worst->where.empty())
      words += fmt::format("{}{:.2e} off {}", words.empty() ? "" : "; ", worst->value, worst->where);
  return judged(std::max(albedo.value, cylinder.value), 2e-3 + 100 * subject.rounding, words);
}

}  // namespace cuticle::study::model_check
