#pragma once
// Fair timing: all points of a study in turn, round after round, each sample beside a run of a fixed kernel.
#include <span>
#include <string>
#include <vector>

#include "study/engine/statistics.h"

namespace cuticle::study {

/// Of one evaluation. `units`: in runs of the kernel, each sample over the median of three runs just before it, so that
/// a machine that is slower for a while slows both; points are ranked by these.
struct PointTime {
  Interval seconds, units;
  int samples = 0, calls = 0;  ///< of a sample
  bool is_timed() const { return samples > 0; }
};
struct Timing {
  std::vector<PointTime> points;
  Interval kernel_seconds;
};

/// The kernel: 200,000 steps x = x a + b in double, each of which waits for the one before. Its processor seconds.
double kernel_run();
inline constexpr std::string_view k_kernel = "200,000 dependent multiply-adds in double, one thread";

/// Times the works: one call each that is not counted; then rounds in which every work runs once, forward and backward
/// in turn (A B C, C B A). `wall`: by wall clock, else by the processor time of the process. Errors: the works'.
Result<Timing> time_in_turn(std::span<const Work* const> works, bool wall, const TimingRequest& request,
                            Progress& progress);

}  // namespace cuticle::study
