// The density of the samples over the whole sphere, with the tilt that is given and with a strong one.
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

constexpr std::array<Situation, 4> pdf_normalised_situations = {
    {{Absorption::given, Roughness::usual, Tilt::strong, Effort::draft},
     {Absorption::given, Roughness::narrowest, Tilt::given, Effort::draft},
     {Absorption::given, Roughness::wide, Tilt::strong, Effort::draft},
     {Absorption::given, Roughness::given, Tilt::none, Effort::draft}}};

}  // namespace

Verdict pdf_normalised(const Subject& subject, const Options& options) {
  Worst worst;
  for (const Scatterer& scatterer :
       scatterers(subject, std::span(pdf_normalised_situations).first(options.quick ? 2 : 4))) {
    if (!scatterer.pdf) return skipped("it has no density");
    for (const bsdf::Point& view : furnace_views(subject, options)) {
      const double sum = integrate_sphere(scatterer.pdf, view, partition_for(scatterer, view)).value.x;
      worst.note(std::abs(sum - 1), fmt::format("{:.6f} at {}", sum, where(subject, scatterer, view)));
    }
  }
  return judged(worst.value, 5e-4 + 100 * subject.rounding, "integral of the density, worst: " + worst.where);
}

}  // namespace cuticle::study::model_check
