#include "study/engine/run.h"

#include <algorithm>

#include <fmt/format.h>

namespace cuticle::study {
namespace {

Error named(Error error, const Group& group, const Point& point) {
  error.message = fmt::format("{}, {}: {}", group.name, point_name(point.method, point.knobs), error.message);
  return error;
}

/// A single item has no spread: its error is known to within the floor of the truth.
void set_interval(ErrorSummary& summary, double floor) {
  if (summary.items == 1) summary.mean = {summary.mean.value, std::max(0.0, summary.mean.value - floor), summary.mean.value + floor};
}

Result<PointResult> measured(const Group& group, const Point& point) {
  auto outcome = point.measure();
  if (!outcome) return named(outcome.error(), group, point);
  CUTICLE_EXPECT(outcome->errors.size() == group.metrics.size(), "one list of errors for each metric");
  PointResult result{point.method, point.knobs, {}, outcome->bytes, {}};
  for (std::size_t m = 0; m < group.metrics.size(); ++m) {
    const auto& errors = outcome->errors[m];
    const Mean mean = group.metrics[m].mean;
    result.metrics.push_back({summarise(errors, mean), summarise(errors, mean, Items::choosing),
                              summarise(errors, mean, Items::judging)});
    set_interval(result.metrics.back().all, group.floor);
  }
  return result;
}

/// Of points that were timed once, while they were made: without an interval.
void add_known_times(const Study& study, StudyResult& result) {
  for (std::size_t g = 0; g < study.groups.size(); ++g)
    for (std::size_t p = 0; p < study.groups[g].points.size(); ++p)
      if (const double seconds = study.groups[g].points[p].seconds; seconds > 0 && !result.groups[g].points[p].time.is_timed())
        result.groups[g].points[p].time = {median_interval({seconds}), median_interval({seconds / result.kernel_seconds.value}), 1, 1};
}

std::size_t count_points(const Study& study) {
  std::size_t count = 0;
  for (const Group& group : study.groups) count += group.points.size();
  return count;
}

}  // namespace

std::string point_name(const std::string& method, const std::vector<Knob>& knobs) {
  std::string name = method;
  for (const Knob& knob : knobs) name += fmt::format(" {}={}", knob.name, knob.value);
  return name;
}

Result<Study> declare(const StudyEntry& entry, const StudyRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(Study study, entry.declare(request, progress));
  if (request.quick) study.timing = study.timing.quick();
  return study;
}

Result<StudyResult> run_study(const Study& study, Progress& progress) {
  StudyResult result;
  std::vector<const Work*> works;
  std::size_t done = 0;
  for (const Group& group : study.groups) {
    GroupResult& of_group = result.groups.emplace_back();
    for (const Point& point : group.points) {
      progress.update("settings", done++, count_points(study));
      CUTICLE_ASSIGN(PointResult of_point, measured(group, point));
      of_group.points.push_back(std::move(of_point));
      works.push_back(&point.work);
    }
  }
  progress.update("settings", done, done);
  CUTICLE_ASSIGN(const Timing times, time_in_turn(works, study.wall_clock, study.timing, progress));
  result.kernel_seconds = times.kernel_seconds;
  std::size_t place = 0;
  for (GroupResult& group : result.groups)
    for (PointResult& point : group.points) point.time = times.points[place++];
  add_known_times(study, result);
  return result;
}

Result<const StudyEntry*> find_study(std::span<const StudyEntry* const> entries, std::string_view name) {
  std::vector<std::string_view> names;
  for (const StudyEntry* entry : entries) {
    if (entry->name == name) return entry;
    names.push_back(entry->name);
  }
  return usage_error(fmt::format("unknown study '{}'", name), fmt::format("known are: {}", fmt::join(names, ", ")));
}

}  // namespace cuticle::study
