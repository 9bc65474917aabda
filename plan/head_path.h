#pragma once
// Where the head is in each frame.
#include <memory>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"
#include "strands/motion/bvh.h"

namespace cuticle::plan {

/// The head's rigid motion: rotation of a BVH joint away from its first pose, scaled by the amplitude, about a pivot;
/// and the joint's travel, scaled to metres.
class HeadPath {
 public:
  /// Error: bad_input from the reader, or naming the joint that is not in the clip.
  static Result<HeadPath> create(const scene::Scene& scene, const glm::dvec3& pivot);
  /// Rest -> world at a frame; the identity where the scene has no motion, and at frame 0.
  glm::dmat4 at(int frame) const;
  /// Where the pivot is, from where it was at frame 0 [m].
  glm::dvec3 travel(int frame) const;

 private:
  glm::dmat4 joint_at(int frame) const;

  std::shared_ptr<const strands::Motion> motion_;
  int joint_ = 0;
  double start_time_ = 0, frame_duration_ = 0, amplitude_ = 1, metres_per_unit_ = 0;
  glm::dvec3 pivot_{0};
};

}  // namespace cuticle::plan
