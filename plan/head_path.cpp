#include <cuticle/plan/head_path.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace cuticle::plan {

namespace {

/// The rotation by `factor` times the angle of q, about its axis, the short way round.
glm::dquat scaled(glm::dquat q, double factor) {
  if (q.w < 0) q = -q;
  const glm::dvec3 vector(q.x, q.y, q.z);
  const double sine = glm::length(vector);
  if (sine < 1e-12) return glm::dquat(1, 0, 0, 0);
  return glm::angleAxis(2 * std::atan2(sine, q.w) * factor, vector / sine);
}

Camera framed(Camera camera, const strands::Bounds& bounds) {
  const glm::dvec3 lower(bounds.lower), upper(bounds.upper);
  const double radius = std::max(1e-3, 0.5 * glm::distance(lower, upper));
  const double aspect = std::min(1.0, double(camera.resolution.x) / camera.resolution.y);
  const double half = std::atan(std::tan(camera.vertical_field_of_view / 2) * aspect);
  const double distance = radius / std::sin(half);
  camera.target = 0.5 * (lower + upper);
  camera.position = camera.target + distance * glm::normalize(glm::dvec3(0.55, 0.2, 1));
  camera.near_plane = std::max(1e-4, distance - 2 * radius);
  camera.far_plane = distance + 4 * radius;
  return camera;
}

}  // namespace

Result<HeadPath> HeadPath::create(const scene::Scene& scene, const glm::dvec3& pivot) {
  HeadPath path;
  path.pivot_ = pivot;
  if (!scene.motion) return path;
  CUTICLE_ASSIGN(strands::Motion motion, strands::read_bvh(scene.motion->bvh));
  CUTICLE_ASSIGN(path.joint_, strands::find_joint(motion, scene.motion->joint));
  path.motion_ = std::make_shared<const strands::Motion>(std::move(motion));
  path.start_time_ = scene.motion->start_time;
  path.frame_duration_ = 1 / scene.frames_per_second;
  path.amplitude_ = scene.motion->amplitude;
  return path;
}

glm::dmat4 HeadPath::at(int frame) const {
  if (!motion_ || frame <= 0) return glm::dmat4(1);
  const glm::dquat first(glm::dmat3(strands::joint_transform(*motion_, joint_, start_time_)));
  const glm::dquat now(glm::dmat3(strands::joint_transform(*motion_, joint_, start_time_ + frame * frame_duration_)));
  const glm::dmat4 turn = glm::mat4_cast(scaled(now * glm::conjugate(first), amplitude_));
  return glm::translate(glm::dmat4(1), pivot_) * turn * glm::translate(glm::dmat4(1), -pivot_);
}

Camera camera_at(const scene::CameraPath& path, const strands::Bounds& rest, int frame) {
  Camera camera = path.automatic ? framed(path.camera, rest) : path.camera;
  const double angle = path.turntable_degrees_per_frame * frame * std::numbers::pi / 180;
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 1, 0)));
  camera.position = camera.target + turn * (camera.position - camera.target);
  return camera;
}

}  // namespace cuticle::plan
