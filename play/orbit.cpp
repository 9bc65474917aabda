#include "play/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace cuticle::play {

namespace {

constexpr double k_highest = 89 * std::numbers::pi / 180;

bool is_finite(const CameraMove& move) {
  return std::isfinite(move.turn.x) && std::isfinite(move.turn.y) && std::isfinite(move.shift.x) &&
         std::isfinite(move.shift.y) && std::isfinite(move.distance);
}

glm::dvec3 turned(const glm::dvec3& offset, const glm::dvec2& turn, double distance) {
  const double length = glm::length(offset);
  const double azimuth = std::atan2(offset.x, offset.z) - turn.x;
  const double height = std::clamp(std::asin(std::clamp(offset.y / length, -1.0, 1.0)) + turn.y, -k_highest, k_highest);
  return distance *
         glm::dvec3(std::cos(height) * std::sin(azimuth), std::sin(height), std::cos(height) * std::cos(azimuth));
}

/// What moves the target so that the picture's content shifts by `shift`.
glm::dvec3 slide(const Camera& camera, const glm::dvec2& shift) {
  const glm::dvec3 ahead = camera.target - camera.position;
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up)), up = glm::normalize(glm::cross(right, ahead));
  const double height = 2 * glm::length(ahead) * std::tan(0.5 * camera.vertical_field_of_view);
  return height * (shift.y * up - shift.x * right);
}

}  // namespace

Camera moved(const Camera& camera, const CameraMove& move) {
  if (move == CameraMove{} || !is_finite(move)) return camera;
  Camera after = camera;
  const glm::dvec3 offset = camera.position - camera.target;
  const double nearest = 2 * camera.near_plane;
  const double distance =
      std::clamp(glm::length(offset) * move.distance, nearest, std::max(nearest, 0.5 * camera.far_plane));
  after.up = {0, 1, 0};
  after.position = after.target + turned(offset, move.turn, distance);
  const glm::dvec3 along = slide(after, move.shift);
  after.position += along;
  after.target += along;
  return after;
}

}  // namespace cuticle::play
