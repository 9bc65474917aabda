#include "bsdf/yan_fur/way_out.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/quadrature.h"
#include "core/real.h"
#include "bsdf/yan_fur/paths.glslh"

namespace cuticle::bsdf::yan_fur {
namespace {

/// A direction from the medulla to the cuticle: its weight, the transmittance there, and the lengths [radii] of the way
/// through the cortex and of the medulla's chord, which it would take if it were mirrored. A mirrored ray keeps sin
/// gamma_t, so it always meets the medulla again, as long a way through the cortex later.
struct WayOut {
  double weight, transmittance, cortex, chord;
};

/// Nodes for a function that has roots at the ends of [low, high]: Gauss-Legendre after 3 t^2 - 2 t^3.
template <class Visit>
void at_nodes(double low, double high, const Visit& visit) {
  static const QuadratureRule rule = gauss_legendre(12);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double t = 0.5 * (1 + rule.nodes[k]);
    visit(low + (high - low) * t * t * (3 - 2 * t), 3 * rule.weights[k] * t * (1 - t) * (high - low));
  }
}

double transmittance_from_inside(const LayeredFibre& fibre, double cosine) {
  const double squared = 1 - fibre.eta * fibre.eta * (1 - cosine * cosine);
  if (squared <= 0) return 0;
  const Dielectric<double> dielectric{fibre.eta * fibre.eta, (fibre.eta - 1) * (fibre.eta + 1), glm::dvec3(0)};
  const FurPaths<double> paths = make_paths(dielectric, Medulla<double>{}, fibre.layers, 0.0, 1.0);
  return cuticle_reflectance(paths, std::sqrt(squared), cosine).y;
}

/// Even light from the medulla: sin gamma_t = s evenly up to kappa, inclinations by the squared cosine; parted where
/// total reflection sets in.
template <class Visit>
void for_ways_out(const LayeredFibre& fibre, const Visit& visit) {
  const auto at_offset = [&](double s, double weight) {
    const double cos_t = std::sqrt(1 - s * s), half = std::sqrt(std::max(0.0, fibre.kappa * fibre.kappa - s * s));
    const double least = std::sqrt(1 - 1 / (fibre.eta * fibre.eta)) / cos_t;
    const double critical = least < 1 ? std::acos(least) : 0;
    const auto at_inclination = [&](double theta, double share) {
      const double c = std::cos(theta);
      visit(WayOut{weight * share * c * c, transmittance_from_inside(fibre, c * cos_t), (cos_t - half) / c,
                   2 * half / c});
    };
    if (critical > 0) at_nodes(0, critical, at_inclination);
    at_nodes(critical, std::numbers::pi / 2, at_inclination);
  };
  const double total = std::min(fibre.kappa, 1 / fibre.eta);
  at_nodes(0, total, at_offset);
  if (total < fibre.kappa) at_nodes(total, fibre.kappa, at_offset);
}

/// What is left on the way from the first scattering of a visit to the medulla's surface. Even light stays 2 kappa
/// radii in the medulla, however much it is scattered (Blanco and Fournier 2003), of which it has had a part before;
/// ways as long as that in the mean, but spread, as exponentially.
double left_of_visit(const LayeredFibre& fibre) {
  const double depth = 2 * fibre.kappa * fibre.sigma_ms;
  const double before = depth < 1e-4 ? fibre.kappa : 2 * fibre.kappa * (1 / depth - 1 / std::expm1(depth));
  return 1 / (1 + fibre.sigma_ma * (2 * fibre.kappa - before));
}

/// Sums over directions: of light that leaves before the medulla scatters it again, and of all that ends there: leaves,
/// is absorbed, or is scattered and absorbed.
struct Ends {
  double out = 0, all = 0;
  void add(const WayOut& way, double sigma_a, const LayeredFibre& fibre, double visit) {
    const double once = std::exp(-sigma_a * way.cortex), back = once * once * (1 - way.transmittance);
    const double extinction = fibre.sigma_ms + fibre.sigma_ma, met = -std::expm1(-extinction * way.chord);
    const double scattered = extinction > 0 ? fibre.sigma_ms / extinction * met * visit : 0;
    const double ended = std::max(1 - back + back * met, 1e-300);
    out += way.weight * once * way.transmittance / ended;
    all += way.weight * (1 - back + back * (met - scattered)) / ended;
  }
};

glm::dvec3 followed(const LayeredFibre& fibre) {
  const double visit = left_of_visit(fibre);
  Ends ends[3];
  for_ways_out(fibre, [&](const WayOut& way) {
    for (int c = 0; c < 3; ++c) ends[c].add(way, fibre.sigma_a[c], fibre, visit);
  });
  glm::dvec3 share;
  for (int c = 0; c < 3; ++c) share[c] = visit * ends[c].out / std::max(ends[c].all, 1e-300);
  return share;
}

}  // namespace

glm::dvec3 share_let_out(const LayeredFibre& fibre) {
  // Points that are evaluated one by one ask for one fibre again and again.
  thread_local LayeredFibre last;
  thread_local glm::dvec3 share = followed(last);
  if (fibre == last) return share;
  last = fibre;
  return share = followed(fibre);
}

}  // namespace cuticle::bsdf::yan_fur
