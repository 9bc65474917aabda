#pragma once
// The angles between a strand, a light and the eye in double, and how far colours are from those of a model.
#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "bsdf/model.h"

namespace cuticle::tests {

inline bsdf::Point angles_at(const glm::dvec3& point, const glm::dvec3& tangent, const glm::dvec3& eye,
                             const glm::dvec3& to_light) {
  const glm::dvec3 t = glm::normalize(tangent), to_eye = glm::normalize(eye - point);
  const glm::dvec3 across_i = to_light - glm::dot(to_light, t) * t, across_o = to_eye - glm::dot(to_eye, t) * t;
  bsdf::Point at;
  at.theta_i = std::asin(glm::dot(to_light, t));
  at.theta_o = std::asin(glm::dot(to_eye, t));
  at.theta_d = 0.5 * (at.theta_o - at.theta_i);
  at.phi = std::acos(std::clamp(glm::dot(glm::normalize(across_i), glm::normalize(across_o)), -1.0, 1.0));
  return at;
}

struct Apart {
  double relative = 0, of_peak = 0, rms_of_rms = 0;
};

/// The largest difference over the value, where that is above a hundredth of the peak, and over the peak.
inline Apart apart(const std::vector<glm::dvec3>& has, const std::vector<glm::dvec3>& wanted) {
  double peak = 0, square = 0, whole = 0;
  for (const glm::dvec3& value : wanted) peak = std::max({peak, value.x, value.y, value.z});
  Apart result;
  for (std::size_t k = 0; k < has.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double off = std::abs(has[k][c] - wanted[k][c]);
      result.of_peak = std::max(result.of_peak, off / peak);
      if (wanted[k][c] > 0.01 * peak) result.relative = std::max(result.relative, off / wanted[k][c]);
      square += off * off;
      whole += wanted[k][c] * wanted[k][c];
    }
  result.rms_of_rms = std::sqrt(square / whole);
  return result;
}

}  // namespace cuticle::tests
