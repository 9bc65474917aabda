#pragma once
// Mirror, Snell and Fresnel for the walks of this folder: plain vector optics in double, none of it from bsdf.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace cuticle::study::oracle {

/// A direction of travel after the mirror with this unit normal (either side).
inline glm::dvec3 reflect(glm::dvec3 direction, glm::dvec3 normal) {
  return direction - 2 * glm::dot(direction, normal) * normal;
}

/// Snell's law in vectors; `ratio` is index before over index after. The caller knows that no total reflection happens.
inline glm::dvec3 refract(glm::dvec3 direction, glm::dvec3 normal, double ratio) {
  const glm::dvec3 along = ratio * (direction - glm::dot(direction, normal) * normal);
  const double across = std::sqrt(std::max(0.0, 1 - glm::dot(along, along)));
  return along + std::copysign(across, glm::dot(direction, normal)) * normal;
}

/// Fresnel reflectance for unpolarised light from index `before` to index `after`; 1 where it is total.
inline double reflectance(double cosine, double before, double after) {
  const double sine_after = before / after * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  if (sine_after >= 1) return 1;
  const double cosine_after = std::sqrt(1 - sine_after * sine_after);
  const double s = (before * cosine - after * cosine_after) / (before * cosine + after * cosine_after);
  const double p = (after * cosine - before * cosine_after) / (after * cosine + before * cosine_after);
  return (s * s + p * p) / 2;
}

}  // namespace cuticle::study::oracle
