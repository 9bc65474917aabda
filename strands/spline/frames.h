#pragma once
// Frames along strands by parallel transport.
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace cuticle::strands {

/// Unit vectors across a strand at each of its vertices; with the tangent they form a right-handed frame.
struct StrandFrames {
  std::vector<glm::vec3> tangents, normals, binormals;
};

/// Frames along `points` (root first). The first normal is `reference` less its part along the strand (any unit vector
/// across where nothing is left); each next one is carried by the smallest rotation between tangents, so a straight
/// strand keeps one frame, and one that turns back by half a turn keeps its normal. Coincident points keep the tangent
/// before them. All vectors unit and at right angles within 1e-6 (interpolation_test).
StrandFrames frames_along(std::span<const glm::vec3> points, const glm::vec3& reference);

}  // namespace cuticle::strands
