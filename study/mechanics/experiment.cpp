#include "study/mechanics/experiment.h"

#include <atomic>
#include <ctime>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace cuticle::study::mechanics {
namespace {

/// A contestant at one value of the parameter.
struct Run {
  const Contestant* contestant = nullptr;
  double at = 0;
  Result<Outcome> outcome = internal_error("not run");
  double seconds = 0;  ///< processor time
};

/// Of the calling thread.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// On the calling thread alone, whose time then is the run's.
void carry_out(Run& run) {
  tbb::task_arena(1).execute([&] {
    const double begin = processor_seconds();
    run.outcome = run.contestant->run(run.at);
    run.seconds = processor_seconds() - begin;
  });
}

/// All runs of all contestants, several at once.
std::vector<Run> carried_out(std::span<const Experiment> experiments, Progress& progress) {
  std::vector<Run> runs;
  for (const Experiment& experiment : experiments)
    for (const Contestant& contestant : experiment.contestants)
      for (const double at : contestant.at) runs.push_back({&contestant, at});
  std::atomic<std::size_t> done = 0;
  progress.update("runs", 0, runs.size());
  tbb::parallel_for(
      std::size_t(0), runs.size(),
      [&](std::size_t k) {
        carry_out(runs[k]);
        progress.update("runs", ++done, runs.size());
      },
      tbb::simple_partitioner());
  return runs;
}

/// Of one contestant.
struct Runs {
  std::vector<Outcome> outcomes;
  double seconds = 0;  ///< processor time of one, in the mean
};

/// The next contestant's, of all in their order.
Result<Runs> next_runs(const Contestant& contestant, std::span<const Run>& rest) {
  Runs runs;
  for (const Run& run : rest.first(contestant.at.size())) {
    CUTICLE_ASSIGN(const Outcome outcome, run.outcome);
    runs.outcomes.push_back(outcome);
    runs.seconds += run.seconds / double(contestant.at.size());
  }
  rest = rest.subspan(contestant.at.size());
  return runs;
}

Point point_of(const Experiment& experiment, const Contestant& contestant, const Runs& runs) {
  std::vector<double> errors, residuals;
  for (const Outcome& outcome : runs.outcomes) {
    errors.push_back(experiment.is_relative ? outcome.found / outcome.truth - 1 : outcome.found - outcome.truth);
    residuals.push_back(outcome.residual);
  }
  return {.method = contestant.solver,
          .knobs = contestant.knobs,
          .measure = [=]() -> Result<Measured> {
            return Measured{{errors, residuals}};
          },
          .seconds = runs.seconds};
}

Curve drawn(const Contestant& contestant, const Runs& runs) {
  Curve curve{contestant.solver, contestant.at, {}, true};
  for (const Knob& knob : contestant.knobs) curve.name += fmt::format(", {} {}", knob.value, knob.name);
  for (const Outcome& outcome : runs.outcomes) curve.y.push_back(outcome.found);
  return curve;
}

Result<void> add_experiment(Study& study, const Experiment& experiment, std::span<const Run>& rest) {
  Group group{.name = experiment.name,
              .title = experiment.title,
              .truth = experiment.truth,
              .metrics = {{"error", experiment.error}, {"residual", experiment.residual}},
              .item = "run"};
  Plot plot{experiment.name,        experiment.title,  experiment.x_label,       experiment.y_label,      false,
            experiment.logarithmic, experiment.curves, experiment.logarithmic_x, experiment.logarithmic_y};
  for (const Contestant& contestant : experiment.contestants) {
    CUTICLE_ASSIGN(const Runs runs, next_runs(contestant, rest));
    group.points.push_back(point_of(experiment, contestant, runs));
    if (contestant.is_drawn) plot.curves.push_back(drawn(contestant, runs));
  }
  study.groups.push_back(std::move(group));
  study.plots.push_back(std::move(plot));
  return {};
}

}  // namespace

std::vector<double> some_of(const std::vector<double>& many, bool quick) {
  std::vector<double> some;
  for (std::size_t k = 0; k < many.size(); k += quick ? 2 : 1) some.push_back(many[k]);
  return some;
}

std::vector<double> ends_of(const std::vector<double>& many, bool quick) {
  return quick ? std::vector{many.front(), many.back()} : many;
}

Result<void> add_experiments(Study& study, std::span<const Experiment> experiments, Progress& progress) {
  const std::vector<Run> all = carried_out(experiments, progress);
  std::span<const Run> rest = all;
  for (const Experiment& experiment : experiments) CUTICLE_TRY(add_experiment(study, experiment, rest));
  return {};
}

}  // namespace cuticle::study::mechanics
