#include "study/model_check/diagnose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/core.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/checks/chi_square.h"
#include "study/model_check/mean_attenuation.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;

/// What the probes share.
struct Case {
  const Subject& subject;
  std::span<const Verdict> verdicts;
  const Options& options;

  bool failed(std::string_view check) const {
    return std::any_of(verdicts.begin(), verdicts.end(),
                       [&](const Verdict& v) { return v.check == check && v.state == State::failed; });
  }
};
using Finding = std::optional<Diagnosis>;

/// Three views away from grazing.
std::vector<bsdf::Point> probe_views(const Subject& subject) {
  std::vector<bsdf::Point> views;
  for (double theta : {0.0, 0.6, -1.05})
    views.push_back({.theta_o = theta, .h = subject.near_field ? 0.3 : 0, .phi_o = 0.7});
  return views;
}

/// The energy that a fibre without absorption should scatter: all of it, or what its orders carry.
double expected_energy(const Subject& subject, const Scatterer& scatterer, const bsdf::Point& view) {
  if (subject.complete || !scatterer.cylinder) return 1;
  return subject.near_field ? attenuation_at(*scatterer.cylinder, view.theta_o, view.h).x
                            : mean_attenuation(*scatterer.cylinder, view.theta_o).x;
}

/// The integral of S cos(theta_i)^(1 + power) over what is expected of that of S cos(theta_i), as range over the views.
struct Ratio {
  double least = 1e300, most = -1e300;
  bool near(double value, double tolerance) const {
    return least > value * (1 - tolerance) && most < value * (1 + tolerance);
  }
};

Ratio energy_ratio(const Case& at, double power) {
  Ratio ratio;
  const std::optional<Scatterer> scatterer = at.subject.make({Absorption::none, Roughness::usual, Tilt::given});
  const Batch weighted = [&](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    scatterer->scattering(points, out);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] *= std::pow(std::cos(points[i].theta_i), power);
  };
  for (const bsdf::Point& view : probe_views(at.subject)) {
    const double energy = largest(integrate_sphere(weighted, view, partition_for(*scatterer, view)).value);
    const double value = energy / expected_energy(at.subject, *scatterer, view);
    ratio.least = std::min(ratio.least, value);
    ratio.most = std::max(ratio.most, value);
  }
  return ratio;
}

Finding weights_are_values(const Case& at) {
  if (!at.failed("sample_weights")) return {};
  const std::optional<Scatterer> scatterer = at.subject.make({});
  const bsdf::Point view = probe_views(at.subject)[1];
  double plain = 0, multiplied = 0;
  for (const bsdf::Sample& sample : draw(*scatterer, view, 500, 1)) {
    const glm::dvec3 s = value_at(scatterer->scattering, point_of(sample, view));
    if (!(largest(s) > 0) || !(sample.pdf > 0)) continue;
    plain = std::max(plain, largest(sample.weight - s) / largest(s));
    multiplied = std::max(multiplied, largest(sample.weight - s * sample.pdf) / largest(s * sample.pdf));
  }
  const double tolerance = 1e-6 + 1e3 * at.subject.rounding;
  if (plain > tolerance && multiplied > tolerance) return {};
  return Diagnosis{Cause::value_times_pdf,
                   fmt::format("every weight is S{}, not S / pdf", plain <= tolerance ? "" : " times pdf")};
}

Finding factor_of_pi(const Case& at) {
  const Ratio ratio = energy_ratio(at, 0);
  for (double factor : {1 / pi, pi})
    if (ratio.near(factor, 0.02))
      return Diagnosis{Cause::spurious_one_over_pi,
                       fmt::format("without absorption it scatters {:.5f} .. {:.5f}, in every view {:.5f}", ratio.least,
                                   ratio.most, factor)};
  return {};
}

Finding cosine(const Case& at) {
  constexpr double tolerance = 5e-3;
  if (energy_ratio(at, 0).near(1, tolerance)) return {};
  if (energy_ratio(at, 1).near(1, tolerance))
    return Diagnosis{Cause::missing_cosine, "S cos(theta_i) keeps energy where S should: S carries 1 / cos(theta_i)"};
  if (energy_ratio(at, -1).near(1, tolerance))
    return Diagnosis{Cause::cosine_included, "S / cos(theta_i) keeps energy where S should: S carries cos(theta_i)"};
  return {};
}

/// Both directions with the fibre's axis and the direction of azimuth 0 exchanged.
bsdf::Point with_axes_swapped(const bsdf::Point& at) {
  const auto swapped = [](double& theta, double& phi) {
    const double along = std::cos(theta) * std::cos(phi), across = std::cos(theta) * std::sin(phi);
    phi = std::atan2(across, std::sin(theta));
    theta = std::asin(std::clamp(along, -1.0, 1.0));
  };
  bsdf::Point other = at;
  double phi_i = at.phi_o + at.phi;
  swapped(other.theta_i, phi_i);
  swapped(other.theta_o, other.phi_o);
  other.phi = phi_i - other.phi_o;
  other.theta_d = (other.theta_o - other.theta_i) / 2;
  return other;
}

/// How far S lies from the cone of mirror directions: the mean of (sin(theta_i) + sin(theta_o))^2 over S.
double off_the_cone(const Batch& scattering, const bsdf::Point& view) {
  constexpr int rings = 96, around = 192;
  std::vector<bsdf::Point> points(std::size_t(rings) * around, view);
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].theta_i = std::asin(-1 + 2 * (double(k / around) + 0.5) / rings);
    points[k].phi = 2 * pi * (double(k % around) + 0.5) / around - pi;
    points[k].theta_d = (view.theta_o - points[k].theta_i) / 2;
  }
  const std::vector<glm::dvec3> values = values_at(scattering, points);
  double sum = 0, whole = 1e-300;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double off = std::sin(points[k].theta_i) + std::sin(view.theta_o);
    sum += brightness(values[k]) * off * off;
    whole += brightness(values[k]);
  }
  return sum / whole;
}

/// Only with the axes exchanged once more S lies about the cone of mirror directions.
Finding frame(const Case& at) {
  std::optional<Scatterer> scatterer = at.subject.make({Absorption::none, Roughness::usual, Tilt::none});
  if (!scatterer) scatterer = at.subject.make({});
  if (!scatterer) return {};
  const Batch unswapped = [&](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    std::vector<bsdf::Point> others(points.size());
    std::transform(points.begin(), points.end(), others.begin(), with_axes_swapped);
    scatterer->scattering(others, out);
  };
  double own = 1e300, other = 0;
  for (bsdf::Point view : probe_views(at.subject)) {
    view.phi_o = 0;  // a function that is given the difference of azimuths alone counts from the viewer's
    own = std::min(own, off_the_cone(scatterer->scattering, view));
    other = std::max(other, off_the_cone(unswapped, view));
  }
  if (own < 2 * other) return {};
  return Diagnosis{Cause::frame_swapped,
                   fmt::format("S lies off the cone of mirror directions by {:.2f}, with the fibre's axis and the "
                               "binormal exchanged by {:.2f} at most",
                               std::sqrt(own), std::sqrt(other))};
}

/// S along theta_i at points spread evenly over a range.
struct Line {
  std::vector<double> theta, value;
  /// By how much the value at point i differs from the mean of its neighbours', relative to it.
  double bend(std::size_t i) const { return std::abs(value[i + 1] - 2 * value[i] + value[i - 1]) / value[i]; }
};

Line line_along_theta(const Scatterer& scatterer, const bsdf::Point& view, double low, double high, int parts) {
  std::vector<bsdf::Point> points(std::size_t(parts) + 1, view);
  Line line;
  for (std::size_t i = 0; i < points.size(); ++i)
    line.theta.push_back(points[i].theta_i = low + (high - low) * double(i) / parts);
  for (const glm::dvec3& value : values_at(scatterer.scattering, points)) line.value.push_back(brightness(value));
  return line;
}

/// The relative step of S towards smaller |theta_i| that is left when a range is narrowed around its sharpest bend: a
/// smooth bend vanishes, a jump stays.
double jump_within(const Scatterer& scatterer, const bsdf::Point& view, double low, double high) {
  while (high - low > 1e-10) {
    const Line line = line_along_theta(scatterer, view, low, high, 16);
    std::size_t sharpest = 1;
    for (std::size_t i = 2; i + 1 < line.value.size(); ++i)
      if (line.bend(i) > line.bend(sharpest)) sharpest = i;
    low = line.theta[sharpest - 1];
    high = line.theta[sharpest + 1];
  }
  const Line ends = line_along_theta(scatterer, view, low, high, 1);
  const double step = (ends.value[1] - ends.value[0]) / std::max(ends.value[0], ends.value[1]);
  return std::abs(ends.theta[1]) < std::abs(ends.theta[0]) ? step : -step;
}

double larger(double a, double b) { return std::abs(a) > std::abs(b) ? a : b; }

/// The largest jump among the sharpest bends of S where it is above a thousandth of its peak.
double jump_along_theta(const Scatterer& scatterer, const bsdf::Point& view) {
  const Line line = line_along_theta(scatterer, view, -1.55, 1.55, 4000);
  const double peak = *std::max_element(line.value.begin(), line.value.end());
  std::vector<std::pair<double, std::size_t>> bends;
  for (std::size_t i = 1; i + 1 < line.value.size(); ++i)
    if (line.value[i] > 1e-3 * peak) bends.emplace_back(line.bend(i), i);
  std::sort(bends.rbegin(), bends.rend());
  double worst = 0;
  for (std::size_t k = 0; k < std::min<std::size_t>(bends.size(), 8); ++k)
    worst =
        larger(worst, jump_within(scatterer, view, line.theta[bends[k].second - 1], line.theta[bends[k].second + 1]));
  return worst;
}

/// Energy and density miss the same share: the longitudinal lobe, which both hold, is not normalised. Without a density
/// a jump tells. The argument of I0 grows towards theta_i = 0: where S steps up on that way, what was left behind, the
/// series of small arguments, is too little.
Finding longitudinal_lobe(const Case& at) {
  const std::optional<Scatterer> scatterer = at.subject.make({Absorption::none, Roughness::usual, Tilt::given});
  if (scatterer->pdf && !at.failed("pdf_normalised")) return {};
  double missing = 0;
  bsdf::Point view;  // the one that misses most
  for (const bsdf::Point& probe : probe_views(at.subject)) {
    const SphereIntegral sum = integrate_sphere(scatterer->scattering, probe, partition_for(*scatterer, probe), {1e-5});
    const double share = 1 - largest(sum.value) / expected_energy(at.subject, *scatterer, probe);
    if (std::abs(share) > std::abs(missing)) view = probe;
    missing = larger(missing, share);
  }
  const double density =
      scatterer->pdf ? 1 - integrate_sphere(scatterer->pdf, view, partition_for(*scatterer, view), {1e-5}).value.x
                     : missing;
  if (std::abs(missing) < 1e-4 || std::abs(missing - density) > 0.3 * std::abs(missing)) return {};
  double jump = 0;
  for (double phi : {0.3, -0.6, 2.8}) {
    bsdf::Point along = view;
    along.phi = phi;
    jump = larger(jump, jump_along_theta(*scatterer, along));
  }
  std::string words = fmt::format("S misses {:.3f} % of the energy", 100 * missing);
  if (scatterer->pdf) words += fmt::format(" and the density {:.3f} %", 100 * density);
  if (std::abs(jump) < 1e-4 + 100 * at.subject.rounding)
    return scatterer->pdf ? Finding(Diagnosis{Cause::lobe_not_normalised, words}) : Finding();
  const bool is_short = jump > 0;
  return Diagnosis{is_short ? Cause::short_bessel_series : Cause::halved_bessel_correction,
                   fmt::format("{}; along theta_i S jumps by {:.2f} %, as where two branches of I0 meet, and is too "
                               "small on the side of the {} argument",
                               words, 100 * std::abs(jump), is_short ? "smaller" : "larger")};
}

/// The largest difference between the energy scattered and that of a cylinder with a mistake built in.
double off_cylinder(const Case& at, const Scatterer& scatterer, Physics physics) {
  double worst = 0;
  for (const bsdf::Point& view : probe_views(at.subject)) {
    const Cylinder& cylinder = *scatterer.cylinder;
    const glm::dvec3 truth = at.subject.near_field ? attenuation_at(cylinder, view.theta_o, view.h, physics)
                                                   : mean_attenuation(cylinder, view.theta_o, physics);
    worst = std::max(worst, largest(scattered_energy(scatterer, view).value - truth));
  }
  return worst;
}

Finding absorption(const Case& at) {
  const std::optional<Scatterer> scatterer = at.subject.make({Absorption::coloured, Roughness::narrowest, Tilt::none});
  if (!at.failed("absorbing_furnace") || !scatterer->cylinder) return {};
  struct Hypothesis {
    Physics physics;
    Cause cause;
    std::string_view words;
  };
  constexpr std::array<Hypothesis, 3> hypotheses = {
      {{Physics::squared_path, Cause::squared_absorption_path, "absorption along the square of the chord"},
       {Physics::index_not_projected, Cause::wrong_bravais_index, "refraction by eta instead of eta'"},
       {Physics::index_of_the_other_polarisation, Cause::wrong_bravais_index, "refraction by eta'' instead of eta'"}}};
  const double correct = off_cylinder(at, *scatterer, Physics::correct);
  for (const Hypothesis& h : hypotheses) {
    const double off = off_cylinder(at, *scatterer, h.physics);
    if (off < 0.2 * correct && off < 0.01)
      return Diagnosis{
          h.cause, fmt::format("the energy is {:.1e} off that of a cylinder, {:.1e} with {}", correct, off, h.words)};
  }
  return {};
}

Finding tilt(const Case& at) {
  if (!at.failed("chi_square")) return {};
  const auto least = [&](Tilt tilt) {
    const std::optional<Scatterer> scatterer = at.subject.make({Absorption::given, Roughness::usual, tilt});
    double p = 1;
    for (const bsdf::Point& view : sampling_views(at.subject, at.options))
      p = std::min(p, sampler_probability(*scatterer, view, 65536, at.options.seed));
    return p;
  };
  const double untilted = least(Tilt::none), tilted = least(Tilt::strong);
  if (untilted < 1e-3 || tilted > 1e-4) return {};
  return Diagnosis{Cause::tilt_after_sampling,
                   fmt::format("samples follow their density without tilt (p = {:.2g}), not with it (p = {:.2g})",
                               untilted, tilted)};
}

}  // namespace

std::string_view name_of(Cause cause) {
  constexpr std::array<std::string_view, 13> names = {"none",
                                                      "unknown",
                                                      "halved_bessel_correction",
                                                      "lobe_not_normalised",
                                                      "squared_absorption_path",
                                                      "wrong_bravais_index",
                                                      "missing_cosine",
                                                      "cosine_included",
                                                      "spurious_one_over_pi",
                                                      "tilt_after_sampling",
                                                      "value_times_pdf",
                                                      "short_bessel_series",
                                                      "frame_swapped"};
  return names[std::size_t(cause)];
}

Diagnosis diagnose(const Subject& subject, std::span<const Verdict> verdicts, const Options& options) {
  const Case at{subject, verdicts, options};
  const bool any =
      std::any_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.state == State::failed; });
  if (!any) return {};
  std::vector<Finding (*)(const Case&)> probes = {weights_are_values, frame};
  if (at.failed("white_furnace")) probes.insert(probes.end(), {factor_of_pi, cosine, longitudinal_lobe});
  probes.insert(probes.end(), {absorption, tilt});
  for (const auto probe : probes)
    if (const Finding found = probe(at)) return *found;
  return {Cause::unknown, "no single mistake known here explains what failed"};
}

}  // namespace cuticle::study::model_check
