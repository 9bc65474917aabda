#include "study/mechanics/experiment.h"

#include <cmath>
#include <ctime>

#include <fmt/format.h>

namespace cuticle::study::mechanics {
namespace {

struct Runs {
  std::vector<Outcome> outcomes;
  double seconds = 0;  ///< processor time of one, in the mean
};

Result<Runs> run_all(const Contestant& contestant) {
  Runs runs;
  const std::clock_t start = std::clock();
  for (const double at : contestant.at) {
    CUTICLE_ASSIGN(const Outcome outcome, contestant.run(at));
    runs.outcomes.push_back(outcome);
  }
  runs.seconds = double(std::clock() - start) / CLOCKS_PER_SEC / double(std::max<std::size_t>(1, contestant.at.size()));
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

}  // namespace

std::vector<double> some_of(const std::vector<double>& many, bool quick) {
  std::vector<double> some;
  for (std::size_t k = 0; k < many.size(); k += quick ? 2 : 1) some.push_back(many[k]);
  return some;
}

std::vector<double> ends_of(const std::vector<double>& many, bool quick) {
  return quick ? std::vector{many.front(), many.back()} : many;
}

Result<void> add_experiment(Study& study, const Experiment& experiment, Progress& progress) {
  Group group{.name = experiment.name,
              .title = experiment.title,
              .truth = experiment.truth,
              .metrics = {{"error", experiment.error}, {"residual", experiment.residual}},
              .item = "run"};
  Plot plot{experiment.name,        experiment.title,  experiment.x_label,       experiment.y_label,      false,
            experiment.logarithmic, experiment.curves, experiment.logarithmic_x, experiment.logarithmic_y};
  for (const Contestant& contestant : experiment.contestants) {
    progress.message(fmt::format("{}: {}", experiment.name, contestant.solver));
    CUTICLE_ASSIGN(const Runs runs, run_all(contestant));
    group.points.push_back(point_of(experiment, contestant, runs));
    if (contestant.is_drawn) plot.curves.push_back(drawn(contestant, runs));
  }
  study.groups.push_back(std::move(group));
  study.plots.push_back(std::move(plot));
  return {};
}

}  // namespace cuticle::study::mechanics
