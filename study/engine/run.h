#pragma once
// Runs a declared study: errors, times, conclusions; and its files (study/README.md).
#include <string>

#include "core/json/json.h"
#include "study/engine/statistics.h"
#include "study/engine/timing.h"

namespace cuticle::study {

/// One metric of one point: over all items, and over the halves.
struct MetricResult {
  ErrorSummary all, choosing, judging;
};
struct PointResult {
  std::string method;
  std::vector<Knob> knobs;
  std::vector<MetricResult> metrics;  ///< as the group's
  double bytes = 0;
  PointTime time;
};
struct GroupResult {
  std::vector<PointResult> points;
};
struct StudyResult {
  std::vector<GroupResult> groups;  ///< as the study's
  Interval kernel_seconds;
};

/// The study as its entry declares it; of a quick form with fewer samples of each time. Errors: those of `declare`.
Result<Study> declare(const StudyEntry& entry, const StudyRequest& request, Progress& progress);

/// Measures and times every point. Error: the points', with the name of the point before it.
Result<StudyResult> run_study(const Study& study, Progress& progress);

/// "method name=value name=value": unlike those of all other points of its group.
std::string point_name(const std::string& method, const std::vector<Knob>& knobs);

/// result.json: all that is the same from run to run on one build and device. times.json: all that is not.
Json result_json(const Study& study, const StudyResult& result, const std::string& command);
Json times_json(const Study& study, const StudyResult& result);
/// conclusions.json: for each group its front, knee, cheapest for an error, most accurate within a time, exponents; and
/// pairs of methods that are ranked for certain. Settings are chosen on one half of the items, judged on the other.
Json conclusions_json(const Study& study, const StudyResult& result);
/// A line a point: group, method, the knobs, mean error, its interval and quantiles, bytes. No times.
std::string result_csv(const Study& study, const StudyResult& result);

/// Writes the four, and the pictures, into a folder, which is made. result.json last: where it is, all is.
Result<void> write_study(const Study& study, const StudyResult& result, const std::string& command,
                         const std::string& folder);

}  // namespace cuticle::study
