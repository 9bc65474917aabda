#pragma once
// A scene that someone plays with, without a window: what was done to it, and the pictures that come of it.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plan/frame_runner_gpu.h"
#include "play/orbit.h"

namespace cuticle::play {

/// Parameters that can be changed while frames are drawn: of the material's model, or of an entry of the plan.
struct ParameterGroup {
  const registry::Entry* entry = nullptr;
  registry::ParameterValues values;
};

/// One parameter's new value. Entries of different kinds may share a name.
struct ParameterChange {
  registry::EntryKind kind;
  std::string entry, parameter;
  registry::Value value;
};

/// What was done since the frame before.
struct Actions {
  CameraMove camera = {};
  bool toggle_pause = false, step = false, restart = false;
  std::string method = {};  ///< how strands are drawn from now on; empty: as before
  std::vector<ParameterChange> changes = {};
};

/// Both included.
struct FrameRange {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

struct SessionCost {
  double frame_ms = 0;   ///< wall clock of the last frame, changes included
  double change_ms = 0;  ///< of the last change of parameters or method: tables, pipelines, replay
};

/// Shows the frames of a range in a loop. A picture is at every moment the one that `render`
/// makes of the changed scene at that frame: after a change of the simulation its frames run anew from the first.
class Session {
 public:
  /// Errors: those of FrameRunner::create; usage for a scene without a picture or a range that is not 0 <= first <= last.
  static Result<std::unique_ptr<Session>> create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                 FrameRange frames, Progress& progress);
  /// Does the actions, goes one frame on unless paused, and draws if anything is new; true where it did.
  /// Error: usage naming an unknown group, parameter or method, or a value out of range; nothing has changed then.
  Result<bool> advance(const Actions& actions);

  const plan::FrameResult& shown() const { return shown_; }
  const scene::Scene& scene() const { return scene_; }
  Camera camera() const { return runner_->camera(std::max(0, frame_)); }
  const plan::Plan& plan() const { return runner_->plan(); }
  const SessionCost& cost() const { return cost_; }
  int frame() const { return frame_; }
  bool is_paused() const { return paused_; }
  /// In the order of the plan, the material first.
  std::vector<ParameterGroup> groups() const;

 private:
  Session(const scene::Scene& scene, FrameRange frames, Progress& progress)
      : scene_(scene), progress_(progress), frames_(frames) {}
  /// The scene with the actions done to it.
  Result<scene::Scene> changed(const Actions& actions) const;
  Result<std::optional<scene::Scene>> change(const Actions& actions);
  int next_frame(const Actions& actions) const;

  scene::Scene scene_;
  Progress& progress_;
  std::unique_ptr<plan::FrameRunner> runner_;
  plan::FrameResult shown_;
  SessionCost cost_;
  FrameRange frames_;
  int frame_ = -1;  ///< before the first picture
  bool paused_ = false;
};

}  // namespace cuticle::play
