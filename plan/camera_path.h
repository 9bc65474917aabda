#pragma once
// Where the camera is in each frame.
#include "core/view.h"
#include "scene/scene.h"
#include "strands/groom.h"

namespace cuticle::plan {

/// When a camera is asked for, and how far the head has travelled by then.
struct CameraTime {
  int frame = 0;
  double seconds = 0;         ///< from frame 0
  glm::dvec3 head_travel{0};  ///< metres
};

/// The camera of a frame: the scene's own; or that of its keys, between them along cubics through the keys, with the
/// velocity at a key that of the line through its neighbours (Catmull-Rom by time); or, if it is automatic, one that
/// sees the whole sphere about the bounds from the front, a little to the right and above. It is then turned by the
/// turntable, and moved as far as the head has travelled where it follows.
Camera camera_at(const scene::CameraPath& path, const strands::Bounds& rest, const CameraTime& when);

}  // namespace cuticle::plan
