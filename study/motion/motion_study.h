#pragma once
// What motion costs: the error of each solver against a converged reference, by substeps and iterations.
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "study/engine/study.h"
#include "study/motion/truths.h"

namespace cuticle::study {

struct MotionRequest {
  std::vector<int> substeps{1, 2, 4, 8, 16, 32}, iterations{1, 4, 16};  ///< in 1/60 s; sweeps of classic
  int reference_substeps = 256;                                         ///< of the reference, in double
  std::vector<double> truth_steps{1.0 / 1920, 1.0 / 960, 1.0 / 480, 1.0 / 240, 1.0 / 120, 1.0 / 60, 1.0 / 30};  ///< s
};
/// Fewer of all: for tests.
MotionRequest quick_motion_request();

/// A group for each of four cases of 0.5 s at 60 Hz, 31 links of a strand of 0.3 m (the curl: a helix of 48 links, 0.1 m): a
/// swing from the horizontal; a head that turns and stops; a swing onto a sphere; a curly rod whose head turns.
/// Reference: `exact` in double with many substeps, for the curl `rod`; the group's floor is what half of its substeps
/// change. Metrics: rms distance over the length after 0.5 s and after 0.2 s, and the largest stretch less 1. Beside
/// them the errors against closed forms of mechanics by the step, as a plot. classic and exact keep the curl as they
/// can, by their pull to the rest pose.
Result<Study> motion_study(const MotionRequest& request, Progress& progress);

}  // namespace cuticle::study
