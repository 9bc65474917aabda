#pragma once
// `cuticle check model`: what a fibre model must hold whatever its formulas are, each a check with a verdict.
#include "core/progress.h"
#include "study/model_check/subject.h"

namespace cuticle::study::model_check {

enum class State { passed, failed, skipped };

/// The outcome of one check: `measured` against `allowed`, which it may not exceed (or, with `at_least`, not fall
/// below).
struct Verdict {
  std::string_view check;
  State state = State::skipped;
  double measured = 0, allowed = 0;
  bool at_least = false;
  std::string words;  ///< what was measured, where it was worst; for a skipped check, why
};

struct Options {
  bool quick = false;      ///< fewer directions and samples
  std::uint64_t seed = 1;  ///< of samples and of the search for values that are not finite
};

/// A check: its name as Model::exceptions uses it, one line on what it holds, and the check.
struct Check {
  std::string_view name, summary;
  Verdict (*run)(const Subject&, const Options&);
};
/// white_furnace, absorbing_furnace, reciprocity, pdf_normalised, chi_square, sample_weights, lobe_tails,
/// caustic_continuity, finite.
std::span<const Check> checks();

/// All checks in their order; the same verdicts for the same seed.
std::vector<Verdict> run_checks(const Subject& subject, const Options& options, Progress& progress);

}  // namespace cuticle::study::model_check
