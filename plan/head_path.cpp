#include "plan/head_path.h"

#include <cmath>

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
  path.metres_per_unit_ = scene.motion->metres_per_unit;
  return path;
}

glm::dmat4 HeadPath::joint_at(int frame) const {
  return strands::joint_transform(*motion_, joint_, start_time_ + frame * frame_duration_);
}

glm::dvec3 HeadPath::travel(int frame) const {
  if (!motion_ || frame <= 0) return glm::dvec3(0);
  return metres_per_unit_ * glm::dvec3(joint_at(frame)[3] - joint_at(0)[3]);
}

glm::dmat4 HeadPath::at(int frame) const {
  if (!motion_ || frame <= 0) return glm::dmat4(1);
  const glm::dquat first(glm::dmat3(joint_at(0))), now(glm::dmat3(joint_at(frame)));
  const glm::dmat4 turn = glm::mat4_cast(scaled(now * glm::conjugate(first), amplitude_));
  return glm::translate(glm::dmat4(1), pivot_ + travel(frame)) * turn * glm::translate(glm::dmat4(1), -pivot_);
}

}  // namespace cuticle::plan
