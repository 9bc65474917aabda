#include "play/session.h"

#include <chrono>
#include <utility>

#include <fmt/core.h>

#include "bsdf/model.h"
#include "core/wall_clock.h"

namespace cuticle::play {

namespace {

using Clock = std::chrono::steady_clock;
using registry::EntryKind;

bool is_solver(const scene::Scene& scene, const registry::Entry& entry) {
  return scene.simulation.solver && scene.simulation.solver->name == entry.name;
}

/// Where a scene keeps the values of an entry of its plan; they are put there if it has none.
registry::ParameterValues& values_of(scene::Scene& scene, const registry::Entry& entry) {
  if (entry.kind == EntryKind::model) return scene.material.model.values;
  if (entry.kind == EntryKind::method) return scene.shadow->values;
  if (is_solver(scene, entry)) return scene.simulation.solver->values;
  auto& blocks = entry.kind == EntryKind::effect ? scene.simulation.effects : scene.passes;
  return blocks.try_emplace(std::string(entry.name), registry::default_values(entry.parameters)).first->second;
}

Result<void> set_value(scene::Scene& scene, const registry::Entry& entry, const ParameterChange& change) {
  CUTICLE_ASSIGN(const registry::Parameter* parameter, registry::find_parameter(entry.parameters, change.parameter));
  CUTICLE_ASSIGN(registry::Value value, registry::parse_value(*parameter, registry::to_text(change.value)));
  values_of(scene, entry).set(change.parameter, std::move(value));
  return {};
}

Result<void> set_method(scene::Scene& scene, const std::string& method) {
  const auto& known = scene::k_render_methods;
  if (std::ranges::find(known, method) == std::end(known))
    return usage_error(fmt::format("method '{}' is not known", method), "cuticle render --help lists them");
  scene.render_method = method;
  return {};
}

}  // namespace

Result<std::unique_ptr<Session>> Session::create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                 FrameRange frames, Progress& progress) {
  if (frames.first < 0 || frames.last < frames.first)
    return usage_error(fmt::format("frames {}:{} are not 0 <= first <= last", frames.first, frames.last));
  if (!scene.outputs.color) return usage_error("outputs.color = false leaves nothing to show");
  std::unique_ptr<Session> session(new Session(scene, frames, progress));
  CUTICLE_ASSIGN(session->runner_, plan::FrameRunner::create(std::move(device), scene, progress));
  return session;
}

std::vector<ParameterGroup> Session::groups() const {
  std::vector<ParameterGroup> groups;
  scene::Scene scene = scene_;
  const auto add = [&](const registry::Entry& entry) {
    if (!entry.parameters.empty()) groups.push_back({&entry, values_of(scene, entry)});
  };
  if (const auto model = bsdf::find_model(scene.material.model.name)) add((*model)->entry);
  for (const plan::PlannedPass& pass : plan().passes) add(*pass.entry);
  return groups;
}

Result<scene::Scene> Session::changed(const Actions& actions) const {
  scene::Scene next = scene_;
  if (actions.camera != CameraMove{}) next.camera = {.camera = moved(camera(), actions.camera)};
  if (!actions.method.empty()) CUTICLE_TRY(set_method(next, actions.method));
  const std::vector<ParameterGroup> known = groups();
  for (const ParameterChange& change : actions.changes) {
    const auto group = std::ranges::find_if(known, [&](const ParameterGroup& one) {
      return one.entry->kind == change.kind && one.entry->name == change.entry;
    });
    if (group == known.end()) return usage_error(fmt::format("'{}' is not in the plan of this scene", change.entry));
    CUTICLE_TRY(set_value(next, *group->entry, change));
  }
  return next;
}

/// The scene before, where the next picture differs from the last of the same frame.
Result<std::optional<scene::Scene>> Session::change(const Actions& actions) {
  const bool nothing = actions.camera == CameraMove{} && actions.method.empty() && actions.changes.empty();
  if (nothing) return std::optional<scene::Scene>();
  const Clock::time_point start = Clock::now();
  CUTICLE_ASSIGN(scene::Scene next, changed(actions));
  CUTICLE_TRY(runner_->change(next, progress_));
  if (!actions.method.empty() || !actions.changes.empty()) cost_.change_ms = milliseconds_since(start);
  return std::optional(std::exchange(scene_, std::move(next)));
}

int Session::next_frame(const Actions& actions) const {
  if (actions.restart || frame_ < 0) return frames_.first;
  if (paused_ && !actions.step) return frame_;
  return frame_ == frames_.last ? frames_.first : frame_ + 1;
}

Result<bool> Session::advance(const Actions& actions) {
  const Clock::time_point start = Clock::now();
  CUTICLE_ASSIGN(std::optional<scene::Scene> before, change(actions));
  paused_ = paused_ != actions.toggle_pause;
  const int next = next_frame(actions);
  if (next == frame_ && !before) return false;
  if (Result<plan::FrameResult> drawn = runner_->run(next); drawn) {
    shown_ = std::move(*drawn);
  } else {
    // Some limits are noticed only when a frame is recorded.
    if (before) {
      CUTICLE_TRY(runner_->change(*before, progress_));
      scene_ = std::move(*before);
    }
    return drawn.error();
  }
  frame_ = next;
  cost_.frame_ms = milliseconds_since(start);
  return true;
}

}  // namespace cuticle::play
