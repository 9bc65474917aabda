#pragma once
// How long things take by the number of strands: the passes of a frame, solvers, shadow methods, strand files.
#include <memory>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "study/engine/study.h"

namespace cuticle::study {

struct GrowthRequest {
  std::vector<int> strands;         ///< how many, rising, each above 0
  int width = 1280, height = 720;   ///< of the frame, pixels
  int frames = 3;                   ///< of each size; the quickest counts; one alone where they take long
  std::string share = {};           ///< as StudyRequest
  std::vector<std::string>* notes;  ///< what was refused, and why
};

/// A frame of the demo head by 'tiles', with deep opacity maps and two lights, strands of 16 vertices, the quickest by
/// the clock: each pass by its timestamps; "all passes", their sum; "submissions", from handing work to the device to
/// its end, all of the frame's; "read back", from there to the picture in memory; "clock", from asking for the frame to
/// that; "processor", of all threads. Where a size is refused it is left out, with a note.
Result<Group> frame_growth(const std::shared_ptr<gpu::Device>& device, const GrowthRequest& request,
                           Progress& progress);
/// A frame of 1/60 s on the CPU by every solver, strands of 16 vertices that hang in gravity: processor time.
Result<Group> solver_growth(const GrowthRequest& request, Progress& progress);
/// Map and lookups at all vertices by every method that has passes on the device, with its defaults, strands of 16
/// vertices: on software Vulkan processor time, else by the clock.
Result<Group> shadow_growth(const std::shared_ptr<gpu::Device>& device, const GrowthRequest& request,
                            Progress& progress);
/// Writing and reading files of every format that is written, strands of 16 vertices: processor time.
Result<Group> file_growth(const GrowthRequest& request, Progress& progress);

}  // namespace cuticle::study
