#pragma once
// Rays of a camera through the points of its picture.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/view.h"

namespace cuticle::render::reference {

/// A lens that is not a point. A radius of 0 is a pinhole, all of it sharp.
struct Lens {
  double radius = 0, focus_distance = 1;  ///< metres; the distance is along the view
};

class CameraRays {
 public:
  explicit CameraRays(const Camera& camera, const Lens& lens = {});
  struct Ray {
    glm::dvec3 origin{0}, direction{0, 0, -1};
  };
  /// Through a point of the picture in pixels, from the left and the top, and a point of the lens' unit disk.
  Ray through(const glm::dvec2& pixel, const glm::dvec2& lens = glm::dvec2(0)) const;
  /// Distance along the view.
  double depth(const glm::dvec3& point) const;

 private:
  glm::dvec3 position_, right_, up_, back_;
  glm::dvec2 size_, shift_;
  double tangent_ = 1;  ///< of half the vertical field of view
  Lens lens_;
};

/// An even point of the unit disk from two numbers in [0, 1).
glm::dvec2 point_of_disk(double u0, double u1);

}  // namespace cuticle::render::reference
