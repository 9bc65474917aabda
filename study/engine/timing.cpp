#include "study/engine/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace cuticle::study {
namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}
double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Samples of one work.
class Timed {
 public:
  Timed(const Work& work, bool wall) : work_(work), wall_(wall) {}

  /// The call that is not counted, and from it how many calls a sample has and how many samples there are. Of slow work
  /// it is the only sample.
  Result<void> warm_up(const TimingRequest& request, double kernel_seconds) {
    CUTICLE_ASSIGN(double seconds, run(1));
    if (seconds < request.sample_seconds) {  // the first call pays for cold caches
      CUTICLE_ASSIGN(seconds, run(1));
    }
    calls_ = std::max(1, int(std::ceil(request.sample_seconds / std::max(seconds, 1e-7))));
    const double sample = seconds * calls_;
    wanted_ = std::min(request.rounds, std::max(3, int(request.point_seconds / std::max(sample, 1e-9))));
    if (seconds > request.slow_seconds) {
      wanted_ = 1;
      keep(seconds, kernel_seconds);
    }
    return {};
  }
  bool wants_more() const { return int(seconds_.size()) < wanted_; }

  Result<void> sample(double kernel_seconds) {
    CUTICLE_ASSIGN(const double seconds, run(calls_));
    keep(seconds / calls_, kernel_seconds);
    return {};
  }
  PointTime result() const {
    return {median_interval(seconds_), median_interval(units_), int(seconds_.size()), calls_};
  }

 private:
  void keep(double call_seconds, double kernel_seconds) {
    seconds_.push_back(call_seconds / work_.evaluations);
    units_.push_back(seconds_.back() / kernel_seconds);
  }
  Result<double> run(int calls) {
    if (work_.before) CUTICLE_TRY(work_.before());
    const double start = wall_ ? wall_seconds() : processor_seconds();
    for (int call = 0; call < calls; ++call) CUTICLE_TRY(work_.run());
    return (wall_ ? wall_seconds() : processor_seconds()) - start;
  }

  const Work& work_;
  bool wall_;
  int calls_ = 1, wanted_ = 0;
  std::vector<double> seconds_, units_;
};

double median_kernel() {
  std::vector<double> runs;
  for (int k = 0; k < 3; ++k) runs.push_back(kernel_run());
  return median_interval(runs).value;
}

}  // namespace

double kernel_run() {
  const double start = processor_seconds();
  volatile double factor = 0.999999, add = 1e-6;
  const double a = factor, b = add;
  double x = 0.5;
  for (int step = 0; step < 200000; ++step) x = x * a + b;
  volatile double sink = x;
  static_cast<void>(sink);
  return std::max(processor_seconds() - start, 1e-9);
}

Result<Timing> time_in_turn(std::span<const Work* const> works, bool wall, const TimingRequest& request,
                            Progress& progress) {
  std::vector<Timed> timed;
  for (const Work* work : works) timed.emplace_back(*work, wall);
  std::vector<double> kernels;
  for (std::size_t i = 0; i < timed.size(); ++i) {
    progress.update("warm-up", i, timed.size());
    if (!works[i]->run) continue;
    kernels.push_back(median_kernel());
    CUTICLE_TRY(timed[i].warm_up(request, kernels.back()));
  }
  for (int round = 0; round < request.rounds; ++round) {
    for (std::size_t k = 0; k < timed.size(); ++k) {
      const std::size_t place = round % 2 == 0 ? k : timed.size() - 1 - k;
      if (!timed[place].wants_more()) continue;
      kernels.push_back(median_kernel());
      CUTICLE_TRY(timed[place].sample(kernels.back()));
    }
    progress.update("rounds of timing", std::size_t(round) + 1, std::size_t(request.rounds));
  }
  if (kernels.empty()) kernels.push_back(median_kernel());
  Timing timing{{}, median_interval(kernels)};
  for (std::size_t i = 0; i < timed.size(); ++i) timing.points.push_back(works[i]->run ? timed[i].result() : PointTime{});
  return timing;
}

}  // namespace cuticle::study
