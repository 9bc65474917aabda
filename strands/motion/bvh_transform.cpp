#include "strands/motion/bvh.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace cuticle::strands {

namespace {

/// A joint relative to its parent.
struct Pose {
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
};

Pose pose_at(const Motion& motion, const Joint& joint, std::size_t frame) {
  Pose pose{joint.offset, {1, 0, 0, 0}};
  const float* values = motion.values.data() + frame * motion.channel_count + std::size_t(joint.first_channel);
  for (std::size_t i = 0; i < joint.channels.size(); ++i) {
    const int channel = joint.channels[i];
    const double value = double(values[i]);
    glm::dvec3 axis(0);
    axis[channel % 3] = 1;
    if (channel < 3)
      pose.translation += axis * value;
    else
      pose.rotation = pose.rotation * glm::angleAxis(glm::radians(value), axis);
  }
  return pose;
}

/// The two frames around a time, and the place between them.
struct FramePlace {
  std::size_t before = 0, after = 0;
  double between = 0;
};
FramePlace frame_place(const Motion& motion, double time) {
  const double last = double(motion.frame_count - 1);
  const double frame = std::isfinite(time) ? std::clamp(time / motion.frame_time, 0.0, last) : 0.0;
  const auto before = std::size_t(std::floor(frame));
  return {before, std::min(before + 1, motion.frame_count - 1), frame - double(before)};
}

glm::dmat4 local_transform(const Motion& motion, const Joint& joint, const FramePlace& place) {
  const Pose a = pose_at(motion, joint, place.before), b = pose_at(motion, joint, place.after);
  const glm::dquat rotation = glm::normalize(glm::slerp(a.rotation, b.rotation, place.between));
  const glm::dvec3 translation = glm::mix(a.translation, b.translation, place.between);
  return glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation);
}

}  // namespace

glm::dmat4 joint_transform(const Motion& motion, int joint, double time) {
  if (motion.frame_count == 0) return glm::dmat4(1);
  CUTICLE_EXPECT(joint >= 0 && std::size_t(joint) < motion.joints.size(), "joint outside the skeleton");
  const FramePlace place = frame_place(motion, time);
  glm::dmat4 world(1);
  for (int j = joint; j >= 0; j = motion.joints[std::size_t(j)].parent)
    world = local_transform(motion, motion.joints[std::size_t(j)], place) * world;
  return world;
}

}  // namespace cuticle::strands
