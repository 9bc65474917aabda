#pragma once
// Whether a frame's picture can show hair, or a shadow that hair casts.
#include "plan/plan.h"
#include "plan/strand_set.h"

namespace cuticle::plan {

/// Where things are in a frame.
struct FramePlaces {
  strands::Bounds hair;  ///< world
  glm::dmat4 head{1};
  Camera camera;
};

/// Not so where the box around the hair, wider by k_view_margin of the picture on each side, is outside the camera's
/// view, and so is every surface that hair casts on. Layers, motion vectors and the methods that look at all of a
/// picture on the CPU always count as seeing it.
registry::Fact hair_in_view(const scene::Scene& scene, const StrandSet& set, const Plan& plan,
                            const FramePlaces& places);

/// For what is drawn wider than it is, and for pixels' filters.
inline constexpr double k_view_margin = 0.1;

/// Whether a box, placed in the world, may be seen: not all corners are beyond the same plane of the view.
bool may_be_seen(const strands::Bounds& box, const glm::dmat4& to_world, const Camera& camera);

}  // namespace cuticle::plan
