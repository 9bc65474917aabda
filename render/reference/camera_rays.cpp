#include "render/reference/camera_rays.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace cuticle::render::reference {

CameraRays::CameraRays(const Camera& camera, const Lens& lens)
    : position_(camera.position),
      size_(camera.resolution),
      shift_(camera.pixel_shift),
      tangent_(std::tan(camera.vertical_field_of_view / 2)),
      lens_(lens) {
  const glm::dmat4 view = view_matrix(camera);
  right_ = {view[0][0], view[1][0], view[2][0]};
  up_ = {view[0][1], view[1][1], view[2][1]};
  back_ = {view[0][2], view[1][2], view[2][2]};
}

CameraRays::Ray CameraRays::through(const glm::dvec2& pixel, const glm::dvec2& lens) const {
  const glm::dvec2 place = (2.0 * (pixel - shift_) - size_) / size_.y * tangent_;
  const glm::dvec3 ahead = place.x * right_ - place.y * up_ - back_;  // one metre along the view
  if (!(lens_.radius > 0)) return {position_, glm::normalize(ahead)};
  const glm::dvec3 origin = position_ + lens_.radius * (lens.x * right_ + lens.y * up_);
  return {origin, glm::normalize(position_ + lens_.focus_distance * ahead - origin)};
}

double CameraRays::depth(const glm::dvec3& point) const { return -glm::dot(point - position_, back_); }

glm::dvec2 point_of_disk(double u0, double u1) {
  const double radius = std::sqrt(u0), turn = 2 * std::numbers::pi * u1;
  return {radius * std::cos(turn), radius * std::sin(turn)};
}

}  // namespace cuticle::render::reference
