#include "study/model_check/gallery/gallery.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "core/random.h"

namespace cuticle::study::model_check {
namespace {

constexpr std::array<Cause, 11> exhibits = {Cause::none,
                                            Cause::halved_bessel_correction,
                                            Cause::squared_absorption_path,
                                            Cause::missing_cosine,
                                            Cause::cosine_included,
                                            Cause::spurious_one_over_pi,
                                            Cause::tilt_after_sampling,
                                            Cause::value_times_pdf,
                                            Cause::wrong_bravais_index,
                                            Cause::short_bessel_series,
                                            Cause::frame_swapped};

TextbookFibre in_situation(TextbookFibre fibre, const Situation& situation) {
  constexpr std::array<double, 5> widths = {0.3, 1e-3, 0.1, 0.25, 0.6};
  fibre.beta = widths[std::size_t(situation.roughness)];
  if (situation.absorption == Absorption::none) fibre.sigma_a = glm::dvec3(0);
  if (situation.tilt == Tilt::none) fibre.tilt = 0;
  if (situation.tilt == Tilt::strong) fibre.tilt = 0.0873;
  return fibre;
}

template <class Function>
Batch over_points(const Function& function) {
  return [function](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    std::transform(points.begin(), points.end(), out.begin(), function);
  };
}

Scatterer scatterer_of(const TextbookFibre& fibre) {
  Scatterer scatterer;
  scatterer.label = fmt::format("beta {:.3g}, sigma_a {:.3g}, tilt {:.3g}", fibre.beta, fibre.sigma_a.x, fibre.tilt);
  scatterer.scattering = over_points([fibre](const bsdf::Point& at) { return scattering(fibre, at); });
  scatterer.pdf = over_points([fibre](const bsdf::Point& at) { return glm::dvec3(density(fibre, at)); });
  scatterer.albedo = over_points([fibre](const bsdf::Point& at) { return albedo(fibre, at.theta_o, at.h); });
  scatterer.sample = [fibre](std::span<const bsdf::SampleQuery> queries, std::span<bsdf::Sample> out) {
    std::transform(queries.begin(), queries.end(), out.begin(),
                   [&](const auto& query) { return sampled(fibre, query); });
  };
  scatterer.cylinder = Cylinder{fibre.eta, fibre.sigma_a, 0};
  return scatterer;
}

TextbookFibre drawn_fibre(TextbookFibre fibre, std::uint64_t number) {
  RandomStream random(number);
  fibre.eta = 1.05 + 1.95 * random.next_unit();
  fibre.sigma_a = glm::dvec3(0, 100 * random.next_unit(), random.next_unit());
  fibre.beta = std::pow(10, -3 * random.next_unit());
  fibre.tilt = 0.1745 * (2 * random.next_unit() - 1);
  return fibre;
}

}  // namespace

std::span<const Cause> gallery() { return exhibits; }

Subject exhibit(Cause mistake) {
  TextbookFibre fibre;
  fibre.mistake = mistake;
  Subject subject;
  subject.name = name_of(mistake);
  subject.near_field = true;
  subject.complete = true;
  subject.lobes = 4;
  subject.make = [fibre](const Situation& situation) { return scatterer_of(in_situation(fibre, situation)); };
  subject.vary = [fibre](std::uint64_t number) { return scatterer_of(drawn_fibre(fibre, number)); };
  return subject;
}

}  // namespace cuticle::study::model_check
