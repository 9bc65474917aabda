#pragma once
// What motion costs: the error of each solver against a converged reference, by substeps and iterations.
#include <map>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "study/motion/truths.h"

namespace cuticle::study {

struct MotionRequest {
  std::vector<int> substeps{1, 2, 4, 8, 16, 32}, iterations{1, 4, 16};  ///< in 1/60 s; sweeps of classic
  int reference_substeps = 256;                                         ///< of the reference, in double
  int repeats = 3;                                                      ///< timings, of which the best counts
  std::vector<double> truth_steps{1.0 / 1920, 1.0 / 960, 1.0 / 480, 1.0 / 240, 1.0 / 120, 1.0 / 60, 1.0 / 30};  ///< s
};
/// Fewer of all: for tests.
MotionRequest quick_motion_request();

/// One solver's setting in one case.
struct MotionRow {
  std::string scene, solver;
  int substeps = 1, iterations = 1;
  double early_error = 0, error = 0;  ///< rms distance over the length, after 0.2 s and 0.5 s
  double largest_stretch = 1;         ///< at 0.5 s
  double us = 0;                      ///< microseconds of processor time a frame and strand, one thread
};
struct MotionStudy {
  std::vector<MotionRow> rows;
  /// By case: rms over the length that half of the reference's substeps change at 0.5 s. Errors below it mean nothing.
  std::map<std::string, double> reference_change;
  std::vector<TruthRow> truths;  ///< errors against closed forms of mechanics, by the step
};

/// Four cases of 0.5 s at 60 Hz, 31 links of a strand of 0.3 m (the curl: a helix of 48 links, 0.1 m): a swing from the
/// horizontal; a head that turns and stops; a swing onto a sphere; a curly rod whose head turns. Reference: `exact` in
/// double with many substeps, for the curl `rod`. classic and exact keep the curl as they can, by their pull to the
/// rest pose.
Result<MotionStudy> run_motion_study(const MotionRequest& request, Progress& progress);

/// The cheapest row of a case with at most this error at 0.5 s; null: none, or the reference is not known so well.
const MotionRow* cheapest(const MotionStudy& study, const std::string& scene, double error);

std::string motion_csv(const MotionStudy& study);
std::string truths_csv(const MotionStudy& study);
/// Writes study.csv, truths.csv and study.json (study/README.md) into a folder, which is made.
Result<void> write_motion_study(const MotionStudy& study, const std::string& folder);

}  // namespace cuticle::study
