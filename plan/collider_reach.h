#pragma once
// Which hair the colliders of a frame can come near, so that a frame in which they cannot touch any has no collisions.
#include <cstddef>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "sim/solver.h"
#include "strands/groom.h"

namespace cuticle::plan {

/// A strand is taken to reach so many times its length from its root: solvers keep lengths within 1e-3 (sim/README.md),
/// and what they move a vertex by before they do is far below half a length.
inline constexpr double k_reach_of_length = 1.5;

/// A ball that holds whatever a strand can reach.
struct ReachBall {
  glm::dvec3 centre{0};  ///< metres, the head's rest space
  double radius = 0;     ///< metres
};
/// One for each control hair. `pearl`: how thick a strand is for colliders, metres.
std::vector<ReachBall> reach_balls(const strands::Groom& rest, double pearl);

/// For each control hair 1 where any collider of the frame comes into its ball in any of the substeps, else 0. Distance
/// fields count as the ball around their grid. input: that of a head, not of a skin.
std::vector<std::uint8_t> hairs_in_reach(std::span<const ReachBall> balls, const sim::FrameInput& input,
                                         std::size_t substeps);

/// Whether every place (world, one per vertex) lies in its hair's ball, which the head has carried.
bool within_reach(std::span<const ReachBall> balls, const strands::Groom& rest, std::span<const glm::vec4> places,
                  const glm::dmat4& head);

}  // namespace cuticle::plan
