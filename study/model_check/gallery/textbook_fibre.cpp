#include "study/model_check/gallery/textbook_fibre.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/model_check/checks/checks.h"

namespace cuticle::study::model_check {
namespace {

using std::numbers::pi;
constexpr int lobes = 4;  // R, TT, TRT, and all further orders at once

/// exp(-x) I0(x): the series of the standard library, and from 12 on 1 + 1/(8x) + 9/(128 x^2) + ... (Abramowitz and
/// Stegun 9.7.1).
double scaled_bessel(double x, Cause mistake) {
  if (x <= 12 && mistake == Cause::short_bessel_series) {
    double term = 1, sum = 1;
    for (int k = 1; k < 10; ++k) sum += term *= x * x / (4.0 * k * k);
    return std::exp(-x) * sum;
  }
  if (x <= 12) return std::exp(-x) * std::cyl_bessel_i(0.0, x);
  if (mistake == Cause::halved_bessel_correction) return std::exp(1 / (16 * x)) / std::sqrt(2 * pi * x);
  double term = 1, sum = 1;
  for (int k = 1; k < 12; ++k) sum += term *= (2 * k - 1) * (2 * k - 1) / (8.0 * k * x);
  return sum / std::sqrt(2 * pi * x);
}

double lobe_width(const TextbookFibre& fibre, int p) { return fibre.beta * (p == 0 ? 1 : p == 1 ? 0.5 : 2); }

/// Of theta_i + theta_o at the peak of a lobe.
double lobe_shift(const TextbookFibre& fibre, int p) {
  constexpr std::array<double, lobes> factor = {-2, 1, 4, 0};
  return fibre.tilt * factor[std::size_t(p)];
}

/// An inclination folded back past the poles.
double folded(double theta) { return std::asin(std::clamp(std::sin(theta), -1.0, 1.0)); }

double longitudinal(const TextbookFibre& fibre, int p, double theta_i, double theta_o) {
  const double variance = std::pow(lobe_width(fibre, p), 2), tilted = folded(theta_o - lobe_shift(fibre, p));
  const double half = std::sin(0.5 * (theta_i + tilted));
  const double bessel = scaled_bessel(std::cos(theta_i) * std::cos(tilted) / variance, fibre.mistake);
  return bessel * std::exp(-2 * half * half / variance) / (variance * -std::expm1(-2 / variance));
}

double logistic_share(double x, double scale) { return 1 / (1 + std::exp(-x / scale)); }

double azimuthal(const TextbookFibre& fibre, int p, double difference) {
  if (p == 3) return 0.5 / pi;
  const double x = std::exp(-std::abs(std::remainder(difference, 2 * pi)) / fibre.beta);
  const double whole = logistic_share(pi, fibre.beta) - logistic_share(-pi, fibre.beta);
  return x / (fibre.beta * (1 + x) * (1 + x)) / whole;
}

/// Where a path at offset h meets the fibre and goes, at one inclination.
struct Path {
  double gamma_i = 0, gamma_t = 0;
  std::array<glm::dvec3, lobes> attenuation{};
  double azimuth(int p) const { return 2 * p * gamma_t - 2 * gamma_i + p * pi; }
};

double fresnel(double eta, double cosine) {
  const double refracted = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
  const double s = (cosine - eta * refracted) / (cosine + eta * refracted);
  const double p = (refracted - eta * cosine) / (refracted + eta * cosine);
  return (s * s + p * p) / 2;
}

double path_length(const TextbookFibre& fibre, double gamma_t) {
  const double chord = 2 * std::cos(gamma_t);
  return fibre.mistake == Cause::squared_absorption_path ? chord * chord : chord;
}

Path path_at(const TextbookFibre& fibre, double theta, double h) {
  const double sine = std::sin(theta) / fibre.eta;
  double index = std::sqrt(fibre.eta * fibre.eta - std::sin(theta) * std::sin(theta)) / std::cos(theta);
  if (fibre.mistake == Cause::wrong_bravais_index) index = fibre.eta * fibre.eta / index;
  Path path{.gamma_i = std::asin(std::clamp(h, -1.0, 1.0)), .gamma_t = std::asin(std::clamp(h / index, -1.0, 1.0))};
  const double f = fresnel(fibre.eta, std::cos(theta) * std::cos(path.gamma_i));
  const double length = path_length(fibre, path.gamma_t) / std::sqrt(1 - sine * sine);
  for (int c = 0; c < 3; ++c) {
    const double t = std::exp(-fibre.sigma_a[c] * length);
    path.attenuation[0][c] = f;
    path.attenuation[1][c] = (1 - f) * (1 - f) * t;
    path.attenuation[2][c] = path.attenuation[1][c] * t * f;
    path.attenuation[3][c] = f * t < 1 ? path.attenuation[2][c] * t * f / (1 - t * f) : 0;
  }
  return path;
}

/// The probability that a sample belongs to each lobe.
std::array<double, lobes> lobe_shares(const Path& path) {
  std::array<double, lobes> shares{};
  double sum = 0;
  for (std::size_t p = 0; p < lobes; ++p) sum += shares[p] = brightness(path.attenuation[p]);
  for (double& share : shares) share /= sum;
  return shares;
}

double with_mistakes(const TextbookFibre& fibre, double theta_i) {
  if (fibre.mistake == Cause::missing_cosine) return 1 / std::cos(theta_i);
  if (fibre.mistake == Cause::cosine_included) return std::cos(theta_i);
  if (fibre.mistake == Cause::spurious_one_over_pi) return 1 / pi;
  return 1;
}

/// theta_i of a direction about the axis (the mirror direction of theta_o) of the von Mises-Fisher lobe.
double drawn_inclination(const TextbookFibre& fibre, int p, double theta_o, double u_depth, double u_turn) {
  const bool late = fibre.mistake == Cause::tilt_after_sampling;
  const double variance = std::pow(lobe_width(fibre, p), 2), shift = lobe_shift(fibre, p);
  const double axis = late ? theta_o : folded(theta_o - shift);
  const double along = std::max(-1.0, 1 + variance * std::log(u_depth + (1 - u_depth) * std::exp(-2 / variance)));
  const double across = std::sqrt(std::max(0.0, 1 - along * along)) * std::cos(2 * pi * u_turn);
  const double theta = std::asin(std::clamp(-along * std::sin(axis) + across * std::cos(axis), -1.0, 1.0));
  return late ? folded(theta + shift) : theta;
}

double drawn_azimuth(const TextbookFibre& fibre, int p, const Path& path, double u) {
  if (p == 3) return 2 * pi * u - pi;
  const double low = logistic_share(-pi, fibre.beta), high = logistic_share(pi, fibre.beta);
  const double share = low + (high - low) * std::clamp(u, 1e-12, 1 - 1e-12);
  return std::remainder(path.azimuth(p) - fibre.beta * std::log(1 / share - 1), 2 * pi);
}

/// The binormal, at azimuth 0, taken for the fibre's axis.
bsdf::Point in_swapped_frame(const bsdf::Point& at) {
  const auto vector = [](double theta, double phi) {
    return glm::dvec3(std::cos(theta) * std::cos(phi), std::sin(theta), std::cos(theta) * std::sin(phi));
  };
  const glm::dvec3 in = vector(at.theta_i, at.phi_o + at.phi), out = vector(at.theta_o, at.phi_o);
  const double phi_o = std::atan2(out.z, out.y);
  return {.theta_i = std::asin(std::clamp(in.x, -1.0, 1.0)),
          .theta_o = std::asin(std::clamp(out.x, -1.0, 1.0)),
          .phi = std::atan2(in.z, in.y) - phi_o,
          .h = at.h,
          .phi_o = phi_o};
}

}  // namespace

glm::dvec3 scattering(const TextbookFibre& fibre, const bsdf::Point& given) {
  const bsdf::Point at = fibre.mistake == Cause::frame_swapped ? in_swapped_frame(given) : given;
  const Path path = path_at(fibre, at.theta_o, at.h);
  glm::dvec3 sum(0);
  for (int p = 0; p < lobes; ++p)
    sum += path.attenuation[std::size_t(p)] *
           (longitudinal(fibre, p, at.theta_i, at.theta_o) * azimuthal(fibre, p, at.phi - path.azimuth(p)));
  return sum * with_mistakes(fibre, at.theta_i);
}

double density(const TextbookFibre& fibre, const bsdf::Point& at) {
  const Path path = path_at(fibre, at.theta_o, at.h);
  const std::array<double, lobes> shares = lobe_shares(path);
  double sum = 0;
  for (int p = 0; p < lobes; ++p)
    sum += shares[std::size_t(p)] * longitudinal(fibre, p, at.theta_i, at.theta_o) *
           azimuthal(fibre, p, at.phi - path.azimuth(p));
  return sum;
}

glm::dvec3 albedo(const TextbookFibre& fibre, double theta_o, double h) {
  const Path path = path_at(fibre, theta_o, h);
  return path.attenuation[0] + path.attenuation[1] + path.attenuation[2] + path.attenuation[3];
}

bsdf::Sample sampled(const TextbookFibre& fibre, const bsdf::SampleQuery& query) {
  const Path path = path_at(fibre, query.theta_o, query.h);
  const std::array<double, lobes> shares = lobe_shares(path);
  int p = 0;
  for (double left = query.u[0]; p < lobes - 1 && left >= shares[std::size_t(p)]; ++p) left -= shares[std::size_t(p)];
  bsdf::Sample sample{.theta_i = drawn_inclination(fibre, p, query.theta_o, query.u[1], query.u[2]),
                      .phi = drawn_azimuth(fibre, p, path, query.u[3])};
  const bsdf::Point at{.theta_i = sample.theta_i, .theta_o = query.theta_o, .phi = sample.phi, .h = query.h};
  sample.pdf = density(fibre, at);
  sample.lobe = p;
  const glm::dvec3 value = scattering(fibre, at);
  sample.weight = fibre.mistake == Cause::value_times_pdf ? value : sample.pdf > 0 ? value / sample.pdf : glm::dvec3(0);
  return sample;
}

}  // namespace cuticle::study::model_check
