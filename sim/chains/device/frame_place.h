#pragma once
// How a head stands and moves in a frame, as kernels read it.
#include <glm/vec4.hpp>

#include "sim/chains/device/layout.glslh"
#include "sim/chains/placing.h"

namespace cuticle::sim::chains {

/// `carry`: by which the whole state is turned first.
inline FramePlace frame_place(const glm::vec4& carry, const Placing& placing) {
  const glm::dmat3 carried = matrix_of(carry);
  const glm::dvec3 zero(0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), moving = placing.velocity(zero);
  const auto packed = [](const glm::dvec3& v) { return glm::vec4(glm::dvec4(v, 0)); };
  return {.carry_x = packed(carried[0]),
          .carry_y = packed(carried[1]),
          .carry_z = packed(carried[2]),
          .turn_x = packed(placing.turned(x)),
          .turn_y = packed(placing.turned(y)),
          .turn_z = packed(placing.turned(z)),
          .turning_x = packed(placing.velocity(x) - moving),
          .turning_y = packed(placing.velocity(y) - moving),
          .turning_z = packed(placing.velocity(z) - moving),
          .translation = packed(placing.world(zero)),
          .moving = packed(moving)};
}

}  // namespace cuticle::sim::chains
