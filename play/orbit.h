#pragma once
// A camera moved by hand.
#include <glm/vec2.hpp>

#include "core/view.h"

namespace cuticle::play {

/// A drag or a turn of the wheel.
struct CameraMove {
  glm::dvec2 turn{0};   ///< radians: to the right about the vertical axis through the target, and upwards
  glm::dvec2 shift{0};  ///< of the picture's content, in heights of the picture: right, down
  double distance = 1;  ///< factor on the distance to the target
  bool operator==(const CameraMove&) const = default;
};

/// The camera after the move. It keeps within 89 degrees of the horizon, at least twice its near plane from the target
/// and within half of its far plane; what is not finite moves nothing.
Camera moved(const Camera& camera, const CameraMove& move);

}  // namespace cuticle::play
