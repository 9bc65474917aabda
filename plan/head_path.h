#pragma once
// Where head and camera are in each frame.
#include <memory>

#include <glm/mat4x4.hpp>

#include <cuticle/core/view.h>
#include <cuticle/scene/scene.h>
#include <cuticle/strands/groom.h>
#include <cuticle/strands/motion/bvh.h>

namespace cuticle::plan {

/// The head's rigid motion: rotation of a BVH joint away from its first pose, scaled by the amplitude, about a pivot.
class HeadPath {
 public:
  /// Error: bad_input from the reader, or naming the joint that is not in the clip.
  static Result<HeadPath> create(const scene::Scene& scene, const glm::dvec3& pivot);
  /// Rest -> world at a frame; the identity where the scene has no motion, and at frame 0.
  glm::dmat4 at(int frame) const;

 private:
  std::shared_ptr<const strands::Motion> motion_;
  int joint_ = 0;
  double start_time_ = 0, frame_duration_ = 0, amplitude_ = 1;
  glm::dvec3 pivot_{0};
};

/// The camera of a frame: the scene's own or, if it is automatic, one that sees the whole sphere about the bounds from
/// the front, a little to the right and above; then turned by the turntable.
Camera camera_at(const scene::CameraPath& path, const strands::Bounds& rest, int frame);

}  // namespace cuticle::plan
