#pragma once
// Two results of a study side by side: machines, commits, and what became slower or less exact.
#include <string>
#include <vector>

#include "core/json/json.h"
#include "core/result.h"
#include "study/engine/statistics.h"

namespace cuticle::study {

/// A point that both have. Times in runs of the kernel, so that machines of unlike speed compare.
struct ComparedPoint {
  std::string study, group, point;
  Interval error_a, error_b, time_a, time_b;
  bool is_timed = false;
  bool slower() const { return is_timed && is_below(time_a, time_b); }
  bool faster() const { return is_timed && is_below(time_b, time_a); }
  bool less_exact() const { return is_below(error_a, error_b); }
  bool more_exact() const { return is_below(error_b, error_a); }
};
struct StudyComparison {
  Json machine_a, machine_b;
  std::vector<ComparedPoint> points;
  std::vector<std::string> only_a, only_b;  ///< "study, group, point"
};

/// Folders that `cuticle study NAME` or `cuticle study all` wrote. Errors: bad_input where one holds no result, or it
/// cannot be read.
Result<StudyComparison> compare_studies(const std::string& a, const std::string& b);

/// What is certain first: regressions, gains; then how many points are equal within their intervals.
std::string to_text(const StudyComparison& comparison);
Json to_json(const StudyComparison& comparison);
bool has_regressions(const StudyComparison& comparison);

}  // namespace cuticle::study
