#pragma once
// What of a plan one frame does: facts that change from frame to frame leave passes out that the scene demands.
#include "plan/plan.h"

namespace cuticle::plan {

/// What was measured of a frame before it is recorded. Each is a fact of the frame, with its words.
struct FrameMeasures {
  registry::Fact hair_awake;          ///< some strand moves, or something acts on hair anew
  registry::Fact colliders_in_reach;  ///< some collider comes within reach of some strand
  registry::Fact hair_changed;        ///< what is drawn of hair, and what it casts shadows with, is not what it was
  registry::Fact surfaces_changed;    ///< head, fins, floor
  registry::Fact view_changed;        ///< the camera, or a pass keeps something from frame to frame
  registry::Fact hair_seen;           ///< hair or a shadow that it casts can be in the picture
};

struct FramePass {
  const PlannedPass* pass = nullptr;
  bool runs = true;
  std::string reason;  ///< why it runs, or why it does not in this frame
  std::uint32_t dispatches() const { return runs ? pass->dispatches : 0; }
  std::uint32_t draws() const { return runs ? pass->draws : 0; }
};
struct FramePlan {
  int frame = 0;
  registry::Facts facts;          ///< of the frame: "hair_awake", "colliders_in_reach", ...
  std::vector<FramePass> passes;  ///< the plan's, in its order
  bool runs(std::string_view pass) const;
  /// Whether any pass of the picture runs; else it is that of the frame before.
  bool paints() const;
};

/// The passes of the plan, which must outlive the result, that a frame runs:
/// - in the stage `simulate` where hair is awake, "colliders" where one is in reach;
/// - of the picture none where neither hair, surfaces nor view changed;
/// - those that need hair where it is seen; of these the stages up to `shadow` where hair changed, and the stage
///   `shadow` where the view changed: it lights the side of a strand that is seen.
FramePlan plan_frame(const Plan& plan, int frame, const FrameMeasures& measures);

/// Whether a pass makes, shadows or draws hair, so that it has nothing to do where none is seen.
bool needs_hair(const registry::Entry& entry);

}  // namespace cuticle::plan
