#include "study/model_check/mean_attenuation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/quadrature.h"

namespace cuticle::study::model_check {
namespace {

/// Fresnel reflectance for unpolarised light that meets glass under a cosine.
double reflectance(double eta, double cosine) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
  const double s = (cosine - eta * inside) / (cosine + eta * inside);
  const double p = (eta * cosine - inside) / (eta * cosine + inside);
  return 0.5 * (s * s + p * p);
}

double index_in_the_normal_plane(double eta, double theta, Physics physics) {
  const double projected = std::sqrt(eta * eta - std::sin(theta) * std::sin(theta)) / std::cos(theta);
  if (physics == Physics::index_not_projected) return eta;
  if (physics == Physics::index_of_the_other_polarisation) return eta * eta / projected;
  return projected;
}

/// What is left after one crossing.
double transmittance(const Cylinder& cylinder, int channel, double theta, double h, Physics physics) {
  const double s = h / index_in_the_normal_plane(cylinder.eta, theta, physics);
  const double cos_squared = std::max(0.0, 1 - s * s);
  const double along = std::sqrt(1 - std::pow(std::sin(theta) / cylinder.eta, 2));
  const double path = physics == Physics::squared_path ? 4 * cos_squared : 2 * std::sqrt(cos_squared);
  return std::exp(-cylinder.sigma_a[channel] * path / along);
}

/// F + (1 - F)^2 T (1 + F T + (F T)^2 + ...), as many terms as there are orders.
double sum_of_orders(double f, double t, int orders) {
  const double first = (1 - f) * (1 - f) * t;
  if (orders == 0) return f + (f * t < 1 ? first / (1 - f * t) : 0);
  double sum = f, path = first;
  for (int p = 1; p < orders; ++p, path *= f * t) sum += path;
  return sum;
}

}  // namespace

glm::dvec3 attenuation_at(const Cylinder& cylinder, double theta, double h, Physics physics) {
  const double f = reflectance(cylinder.eta, std::cos(theta) * std::sqrt(std::max(0.0, 1 - h * h)));
  glm::dvec3 energy;
  for (int c = 0; c < 3; ++c)
    energy[c] = sum_of_orders(f, transmittance(cylinder, c, theta, h, physics), cylinder.orders);
  return energy;
}

glm::dvec3 mean_attenuation(const Cylinder& cylinder, double theta, Physics physics) {
  static const QuadratureRule rule = gauss_legendre(64);
  glm::dvec3 sum(0);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double gamma = 0.5 * std::numbers::pi * rule.nodes[k];
    sum += rule.weights[k] * std::cos(gamma) * attenuation_at(cylinder, theta, std::sin(gamma), physics);
  }
  return 0.25 * std::numbers::pi * sum;
}

}  // namespace cuticle::study::model_check
