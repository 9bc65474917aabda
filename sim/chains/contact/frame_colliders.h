#pragma once
// The colliders of a frame as the CPU's units and the kernels take them.
#include <functional>
#include <vector>

#include "sim/chains/chains.h"

namespace cuticle::sim::chains {

/// None without the effect. On a skin all are as those that move by themselves, in the world. Where none moves by
/// itself, all are in rest space and `carries` is empty. Otherwise the spheres that the head takes along are in rest
/// space, those that move by themselves are boxes without size, and boxes and fields are as ChainFrame::carries says.
template <class Real>
struct FrameColliders {
  std::vector<LinkSphere<Real>> spheres = {};
  std::vector<LinkBox<Real>> boxes = {};
  std::vector<LinkField<Real>> fields = {};
  std::vector<FieldPointer> baked = {};  ///< of each field
  std::vector<ColliderCarry<Real>> carries = {};
  std::vector<LinkSphere<Real>> bounds = {};  ///< in rest space, one per carry: around it all through the substep
  std::size_t substeps = 1;                   ///< to which boxes, fields and carries belong
  std::size_t box_count() const { return boxes.size() / substeps; }
  std::size_t field_count() const { return fields.size() / substeps; }
  std::size_t count() const { return spheres.size() + box_count() + field_count(); }
};
template <class Real>
FrameColliders<Real> frame_colliders(const ChainSettings& settings, const FrameInput& input, std::size_t substeps,
                                     bool on_skin);

/// Those of which `reached` says that a block of strands can reach a sphere around them in the frame, in `near`.
template <class Real>
void find_near(const FrameColliders<Real>& all, const std::function<bool(const LinkSphere<Real>&)>& reached,
               FrameColliders<Real>& near);

}  // namespace cuticle::sim::chains
