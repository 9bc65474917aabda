#pragma once
// Experiments of a laboratory with known results, by every solver that has what they need.
#include <string>
#include <vector>

#include "core/progress.h"
#include "study/engine/study.h"

namespace cuticle::study {

struct MechanicsRequest {
  bool quick = false;
  std::vector<std::string> experiments = {};  ///< by name; none: all
};
std::vector<std::string> mechanics_experiments();

/// A group and a figure for each experiment: the cantilever, a hanging curl that leaves its plane, an arc that falls to
/// the side, a tip that sticks and slips, the capstan over a cylinder and over edges, a catenary, the frequencies of a
/// clamped beam and of a hanging chain, a falling chain's tip, a draped tress. Each runs by the solvers that can:
/// `classic` and `exact` do not bend, `classic` has no friction. Errors against theory or reference/make_curves.py, a
/// residual, and the processor time of one run. `quick`: about half of the parameter's values. Error: usage, of a name
/// that is not known.
Result<Study> mechanics_study(const MechanicsRequest& request, Progress& progress);

}  // namespace cuticle::study
