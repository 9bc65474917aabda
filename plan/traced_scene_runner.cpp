#include "plan/traced_scene_runner.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "plan/camera_path.h"
#include "plan/drawn_strands.h"
#include "plan/simulation.h"

namespace cuticle::plan {

Result<std::unique_ptr<TracedSceneRunner>> TracedSceneRunner::create(const scene::Scene& scene, Progress& progress) {
  if (scene.character || scene.fins)
    return usage_error(fmt::format("'{}': a character's skin and fins are moved on a Vulkan device", scene.name),
                       "leave them out, or render on a device");
  std::unique_ptr<TracedSceneRunner> runner(new TracedSceneRunner(scene));
  CUTICLE_ASSIGN(runner->set_, build_strand_set(scene));
  for (const std::string& note : runner->set_.notes) progress.message(note);
  if (runner->set_.head.triangles.empty()) runner->scene_.head.present = false;
  runner->plan_ = make_plan(runner->scene_, shape_of(runner->scene_, runner->set_), {.is_software = true});
  CUTICLE_ASSIGN(runner->path_, HeadPath::create(runner->scene_, runner->set_.pivot));
  return runner;
}

/// Frame 0 is settled at rest.
Result<void> TracedSceneRunner::restart(Progress& progress) {
  frame_ = -1;
  solver_.reset();
  if (!scene_.simulation.solver) return {};
  CUTICLE_ASSIGN(solver_, make_cpu_solver(scene_, set_, plan_));
  const int frames = int(std::ceil(scene_.simulation.settle_time * scene_.frames_per_second));
  for (int k = 0; k < frames; ++k) {
    CUTICLE_TRY(simulate(0));
    progress.update("settling", std::size_t(k + 1), std::size_t(frames));
  }
  return {};
}

Result<void> TracedSceneRunner::simulate(int frame) {
  return solver_->advance(input_of(scene_, set_, plan_, path_, frame));
}

Result<void> TracedSceneRunner::advance_to(int frame, Progress& progress) {
  if (frame < 0) return usage_error(fmt::format("frame {} is below 0", frame));
  if (frame_ < 0 || frame < frame_) CUTICLE_TRY(restart(progress));
  for (int next = frame_ + 1; solver_ && next <= frame; ++next) {
    CUTICLE_TRY(simulate(next));
    progress.update("frames simulated", std::size_t(next + 1), std::size_t(frame + 1));
  }
  frame_ = frame;
  if (solver_) {
    CUTICLE_ASSIGN(state_, solver_->state());
    return {};
  }
  state_.positions.clear();
  for (const glm::vec3& position : set_.control.positions)
    state_.positions.emplace_back(path_.at(frame) * glm::dvec4(position, 1));
  state_.velocities.assign(state_.positions.size(), glm::vec3(0));
  return {};
}

Result<strands::Groom> TracedSceneRunner::drawn_strands() {
  if (frame_ < 0) return usage_error("no frame has been run");
  return drawn_strands_at(scene_, set_, state_.positions, glm::dmat3(path_.at(frame_)));
}

Camera TracedSceneRunner::camera(int frame) const {
  return camera_at(scene_.camera, strands::bounds(set_.control),
                   {.frame = frame, .seconds = frame / scene_.frames_per_second, .head_travel = path_.travel(frame)});
}

Result<TracedFrame> TracedSceneRunner::run(int frame, Progress& progress) {
  TracedPlaces places{.head = path_.at(frame)};
  if (has_open_shutter(scene_, plan_.facts) && frame > 0) {
    CUTICLE_TRY(advance_to(frame - 1, progress));
    CUTICLE_ASSIGN(strands::Groom hair, drawn_strands());
    places.before = {std::move(hair.positions), camera(frame - 1), path_.at(frame - 1)};
  }
  CUTICLE_TRY(advance_to(frame, progress));
  CUTICLE_ASSIGN(places.hair, drawn_strands());
  return trace_frame(scene_, set_, std::move(places), camera(frame), "", progress);
}

}  // namespace cuticle::plan
