#pragma once
// Numbers that the views of lobes share.
#include <numbers>

#include <glm/vec3.hpp>

namespace cuticle::viz {

inline constexpr double k_degree = std::numbers::pi / 180;  ///< radians

/// Of red, green and blue.
inline double mean(const glm::dvec3& rgb) { return (rgb.x + rgb.y + rgb.z) / 3; }

}  // namespace cuticle::viz
