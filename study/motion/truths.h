#pragma once
// Errors of the strand solvers against closed forms of mechanics, by the time step.
#include <string>
#include <vector>

#include "core/result.h"

namespace cuticle::study {

/// One solver's error at one step; each frame is one substep.
struct TruthRow {
  std::string truth, solver;
  double step = 0;   ///< s
  double error = 0;  ///< as `truth` says, at least 1e-9 so that it can be drawn on a logarithmic axis
};

/// For each of these steps (s, above 0):
/// - a pendulum's period at 30 and 90 degrees against the arithmetic-geometric mean, and that of the lowest mode of a
///   hanging chain of 32 links against the first zero of J0, relative (`exact`, in double);
/// - a chain of 32 links in a side wind with drag after 20 s: its farthest vertex from the line that hangs at tan phi =
///   (drag U) / g, over the length (`exact`);
/// - free fall: hair whose head falls keeps its shape, farthest vertex from it after 0.5 s over the length (`classic`,
///   `exact`, `rod`);
/// - a swing of 31 links without damping: the largest growth of its energy in 2 s, over g L (`exact`);
/// - the heavy elastica clamped horizontally, 64 links, after 20 s: drop over width against the continuous one at Gamma = rho
///   g A L^3 / EI of 10 and 100, relative (`rod`); what is left at any step is that of the links.
Result<std::vector<TruthRow>> run_motion_truths(const std::vector<double>& steps);

}  // namespace cuticle::study
