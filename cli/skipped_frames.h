#pragma once
// Frames before the first that is asked for.
#include "core/interrupt.h"
#include "core/progress.h"
#include "plan/frame_runner_gpu.h"

namespace cuticle::cli {

/// Motion begins at frame 0: says that the frames before `first` are simulated too, shows how far it is, and stops
/// early where that is asked.
inline Result<void> skip_to(plan::FrameRunner& runner, const scene::Scene& scene, int first,
                            const StopsBetweenSteps& stop, Progress& progress) {
  constexpr int frames_at_once = 8;  // what the runner measures after each call costs little beside so many
  if (first == 0 || !scene.simulation.solver) return {};
  progress.message("frames 0 .. " + std::to_string(first - 1) + " are simulated first: motion begins at frame 0");
  for (int frame = std::min(frames_at_once, first) - 1; !stop.is_asked();
       frame = std::min(frame + frames_at_once, first - 1)) {
    CUTICLE_ASSIGN([[maybe_unused]] const plan::FrameResult skipped, runner.run(frame, {.render = false}));
    progress.update("frames before the first", std::size_t(frame) + 1, std::size_t(first));
    if (frame == first - 1) break;
  }
  return {};
}

}  // namespace cuticle::cli
