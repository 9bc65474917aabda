#pragma once
// Light from a picture of the surroundings, drawn by importance.
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "render/reference/traced_scene.h"

namespace cuticle::render::reference {

/// Each texel shines evenly; directions are drawn in proportion to a texel's luminance times its solid angle. Tests:
/// surroundings_light_test.cpp (density integrates to 1, the mean of radiance / density is the integral of radiance).
class SurroundingsLight {
 public:
  /// Errors: bad_input, where the picture is not twice as wide as high or shines nowhere.
  static Result<SurroundingsLight> make(const Surroundings& surroundings);

  struct Drawn {
    glm::dvec3 to_light{0, 1, 0}, radiance{0};
    double density = 0;  ///< per steradian
  };
  Drawn draw(double u0, double u1, double u2) const;
  glm::dvec3 radiance(const glm::dvec3& to_light) const;
  double density(const glm::dvec3& to_light) const;
  /// Whether all texels are the same: a model's own directions then find the light as well as drawn ones.
  bool is_even() const { return is_even_; }

 private:
  std::size_t texel(const glm::dvec3& to_light) const;
  double solid_angle(std::size_t row) const;

  int width_ = 0, height_ = 0;
  bool is_even_ = false;
  double turn_ = 0;
  std::vector<glm::dvec3> radiance_;
  std::vector<double> cumulative_;  ///< shares of the luminance up to and with each texel
};

}  // namespace cuticle::render::reference
