#pragma once
// The smallest change to a scene that would bring a pass in: found by planning changed scenes, so that it holds.
#include <functional>
#include <optional>

#include "plan/plan.h"

namespace cuticle::plan {

/// One change, as a person would write it into the scene file, and made.
struct SceneChange {
  std::string words;  ///< "add \"floor\": {...}"
  std::function<void(scene::Scene&)> make;
};

/// Every change of one key that can bring a pass in: methods, solvers, effects, passes, ways of drawing, lights, things
/// in the scene, outputs.
const std::vector<SceneChange>& scene_changes();

/// What brings a pass in.
struct WayIn {
  std::vector<std::string> changes;  ///< in the order in which they are made; one for most
  Plan plan;                         ///< of the changed scene
};
/// The fewest changes after which the plan holds the entry, at most `most`; none: there are no such. Of ways as short,
/// the one that adds the fewest passes. Only changes that alter why it is left out are followed.
std::optional<WayIn> way_in(const scene::Scene& scene, const registry::FrameShape& shape, const DeviceTraits& device,
                            const registry::Entry& entry, int most = 4);

}  // namespace cuticle::plan
