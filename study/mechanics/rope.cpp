#include "study/mechanics/rope.h"

#include <cmath>
#include <numbers>

#include "study/mechanics/strands.h"

namespace cuticle::study::mechanics {
namespace {

constexpr double k_clear = 1e-6;  ///< m between rope and support at the start

/// Places from the height of the support's left side over it to the right one.
std::vector<glm::dvec3> over(const Rope& rope, const Support& support) {
  const double side = support.radius + k_clear;
  std::vector<glm::dvec3> places;
  if (support.has_edges) {
    for (int i = 0; i <= rope.round; ++i) places.emplace_back(-side + 2 * side * i / rope.round, k_clear, 0);
    return places;
  }
  const double angle = std::numbers::pi / rope.round;
  for (int i = 0; i < rope.round; ++i) {
    const double at = angle * (i + 0.5);
    places.push_back(glm::dvec3(-std::cos(at), std::sin(at), 0) * (side / std::cos(angle / 2)));
  }
  return places;
}

}  // namespace

RoundedBox Support::shape() const {
  if (!has_edges) return make_capsule({0, 0, -0.2}, {0, 0, 0.2}, radius);
  return {.center = {0, -radius, 0}, .half_size = {radius, radius, 0.2}};
}

double Rope::link(const Support& support) const {
  if (support.has_edges) return 2 * (support.radius + k_clear) / round;
  return 2 * support.radius * std::tan(std::numbers::pi / round / 2);
}

strands::Groom Rope::groom(const Support& support) const {
  const double l = link(support), side = support.radius + k_clear, top = support.has_edges ? 0 : l / 2;
  std::vector<glm::dvec3> places;
  for (int i = 0; i <= loop; ++i) places.emplace_back(-side - l, top - l * i, 0);
  for (int i = loop; i > 0; --i) places.emplace_back(-side, top - l * i, 0);
  const std::vector<glm::dvec3> across = over(*this, support);
  places.insert(places.end(), across.begin(), across.end());
  for (int i = 1; i <= hang; ++i) places.emplace_back(side, top - l * i, 0);
  return groom_of(places);
}

double slipping_tension(const Support& support, double loop_tension, double friction) {
  const double radius = support.radius;
  if (support.has_edges) {
    const double edge = std::exp(friction * std::numbers::pi / 2);
    return (loop_tension * edge + friction * 2 * radius) * edge;
  }
  // dT / dphi = R cos phi + friction (T + R sin phi), phi from the loop's side.
  const int steps = 2000;
  const double h = std::numbers::pi / steps;
  const auto slope = [&](double at, double t) {
    return radius * std::cos(at) + friction * (t + radius * std::sin(at));
  };
  double tension = loop_tension;
  for (int k = 0; k < steps; ++k) tension += h * slope((k + 0.5) * h, tension + h / 2 * slope(k * h, tension));
  return tension;
}

double law_friction(const Support& support, double loop_tension, double free_tension) {
  double low = 0, high = 3;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (slipping_tension(support, loop_tension, middle) < free_tension ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace cuticle::study::mechanics
