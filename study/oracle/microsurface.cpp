#include "study/oracle/microsurface.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "study/oracle/optics.h"

namespace cuticle::study::oracle {
namespace {

using glm::dvec3;
using std::numbers::inv_sqrtpi;
using std::numbers::pi;

constexpr int most_facets = 10000;  ///< a walk over facets ends long before, with probability 1

/// Uniform points of the cap z > -toward.z of the sphere are where the unit hemisphere mirrors light from `toward`.
dvec3 visible_ggx(dvec3 toward, RandomStream& random) {
  const double turn = 2 * pi * random.next_unit();
  const double z = 1 - random.next_unit() * (1 + toward.z);
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return dvec3(radius * std::cos(turn), radius * std::sin(turn), z) + toward;
}

/// Integral of (cosine - sine x) exp(-x^2) / sqrt(pi) up to x: visible slopes of Beckmann's distribution.
double slopes_below(double cosine, double sine, double x) {
  return 0.5 * cosine * (1 + std::erf(x)) + 0.5 * inv_sqrtpi * sine * std::exp(-x * x);
}

/// The slope along the direction of view, by bisection; slopes beyond 7 have no weight in double.
double visible_slope(double cosine, double sine, double u) {
  double low = -7, high = sine > 0 ? std::clamp(cosine / sine, -7.0, 7.0) : 7;
  const double target = u * slopes_below(cosine, sine, high);
  for (int i = 0; i < 52; ++i) {
    const double middle = 0.5 * (low + high);
    (slopes_below(cosine, sine, middle) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

dvec3 visible_beckmann(dvec3 toward, RandomStream& random) {
  const double sine = std::hypot(toward.x, toward.y);
  const double along = visible_slope(toward.z, sine, random.next_unit());
  const double reach = std::sqrt(-std::log(1 - random.next_unit()));  // of a Gaussian pair with variance 1/2
  const double across = reach * std::cos(2 * pi * random.next_unit());
  const double c = sine > 0 ? toward.x / sine : 1, s = sine > 0 ? toward.y / sine : 0;
  return {-(c * along - s * across), -(s * along + c * across), 1};
}

/// The share of facets below the height at which the ray meets the next one, from that where it is now; above 1: it is
/// free.
double next_level(const Microsurface& surface, double level, double cosine, RandomStream& random) {
  const double lambda = smith_lambda(surface, cosine), u = random.next_unit();
  if (cosine > 0 && u >= 1 - std::pow(level, lambda)) return 2;
  return level / std::pow(1 - u, 1 / lambda);
}

/// Meets one facet: mirrored or refracted by Fresnel's law. `below` is the side on which the ray travels and may
/// change.
dvec3 meet_facet(dvec3 direction, dvec3 normal, double above, double below_index, bool& below, RandomStream& random) {
  const double before = below ? below_index : above, after = below ? above : below_index;
  const double cosine = std::abs(glm::dot(direction, normal));
  if (random.next_unit() < reflectance(cosine, before, after)) return reflect(direction, normal);
  below = !below;
  return glm::normalize(refract(direction, normal, before / after));
}

/// One facet; light whose new direction ends on the wrong side of the mesosurface is lost, and masked light too.
Meeting meet_once(const Microsurface& surface, dvec3 direction, double above, double below, RandomStream& random) {
  const dvec3 normal = visible_normal(surface, -direction, random);
  Meeting meeting;
  meeting.direction = meet_facet(direction, normal, above, below, meeting.below, random);
  const double cosine = meeting.below ? -meeting.direction.z : meeting.direction.z;
  meeting.energy = cosine > 0 ? 1 / (1 + smith_lambda(surface, cosine)) : 0;
  return meeting;
}

/// From facet to facet until the ray is free on one side. Seen from below, the surface is the same one upside down.
Meeting meet_all(const Microsurface& surface, dvec3 direction, double above, double below, RandomStream& random) {
  Meeting meeting{direction, false, 1};
  double level = 1;
  for (int facet = 0; facet < most_facets; ++facet) {
    const double up = meeting.below ? -1 : 1;
    level = next_level(surface, level, up * meeting.direction.z, random);
    if (level > 1) return meeting;
    const dvec3 normal = up * visible_normal(surface, -up * meeting.direction, random);
    const bool was_below = meeting.below;
    meeting.direction = meet_facet(meeting.direction, normal, above, below, meeting.below, random);
    if (meeting.below != was_below) level = 1 - level;
  }
  meeting.energy = 0;
  return meeting;
}

}  // namespace

double smith_lambda(const Microsurface& surface, double cosine) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double a = cosine / (surface.roughness * sine);  // infinite where there is nothing to mask
  if (!std::isfinite(a)) return cosine > 0 ? 0 : -1;
  if (surface.facets == Facets::ggx) return 0.5 * (std::copysign(std::sqrt(1 + 1 / (a * a)), a) - 1);
  return 0.5 * (std::erf(a) - 1 + inv_sqrtpi * std::exp(-a * a) / a);
}

glm::dvec3 visible_normal(const Microsurface& surface, dvec3 toward, RandomStream& random) {
  const dvec3 stretch(surface.roughness, surface.roughness, 1);
  const dvec3 stretched = glm::normalize(stretch * toward);
  return glm::normalize(
      stretch * (surface.facets == Facets::ggx ? visible_ggx(stretched, random) : visible_beckmann(stretched, random)));
}

Meeting meet_surface(const Microsurface& surface, Blocked blocked, dvec3 direction, double above, double below,
                     RandomStream& random) {
  return blocked == Blocked::lost ? meet_once(surface, direction, above, below, random)
                                  : meet_all(surface, direction, above, below, random);
}

}  // namespace cuticle::study::oracle
