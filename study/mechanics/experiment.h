#pragma once
// Private to study/mechanics: an experiment whose result is known, and strands to run it with.
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/progress.h"
#include "sim/solver.h"
#include "study/engine/study.h"

namespace cuticle::study::mechanics {

/// What one run gave at one value of the experiment's parameter.
struct Outcome {
  double truth = 0, found = 0;
  double residual = 0;  ///< as Experiment::residual says
};

/// A solver with its settings.
struct Contestant {
  std::string solver;
  std::vector<Knob> knobs = {};
  std::vector<double> at = {};  ///< values of the parameter
  std::function<Result<Outcome>(double at)> run = {};
  bool is_drawn = true;
};

struct Experiment {
  std::string name, title, truth;  ///< as of a Group
  std::string x_label, y_label;    ///< of the figure
  bool logarithmic = false;        ///< both axes
  bool logarithmic_x = false, logarithmic_y = false;
  std::string residual = "speed of the fastest vertex at the end, over sqrt(g L)";
  std::string error = "error, relative";
  bool is_relative = true;         ///< error: of found over truth less 1; else their difference
  std::vector<Curve> curves = {};  ///< the theory's
  std::vector<Contestant> contestants = {};
};

/// Runs every contestant at each of its values, several runs at once, each on one thread, and adds a group for each
/// experiment (error, residual, processor time of a run) and a figure.
Result<void> add_experiments(Study& study, std::span<const Experiment> experiments, Progress& progress);

/// `many` in full, with `quick` every other from the first.
std::vector<double> some_of(const std::vector<double>& many, bool quick);
/// `many` in full, with `quick` the first and the last.
std::vector<double> ends_of(const std::vector<double>& many, bool quick);

// Each with fewer values in the quick form.
Experiment cantilever(bool quick);
Experiment hanging_arc(bool quick);
Experiment standing_arc(bool quick);
Experiment stick_slip(bool quick);
Experiment capstan_over_a_cylinder(bool quick);
Experiment capstan_over_edges(bool quick);
Experiment catenary(bool quick);
Experiment clamped_beam(bool quick);
Experiment hanging_chain(bool quick);
Experiment falling_chain(bool quick);
Experiment drape(bool quick);

}  // namespace cuticle::study::mechanics
