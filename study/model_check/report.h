#pragma once
// The verdicts on one model with its stated exceptions, as text and as JSON: what the program and Python print.
#include "study/model_check/diagnose.h"

namespace cuticle::study::model_check {

struct Report {
  std::string name;
  std::vector<Verdict> verdicts;
  std::vector<bsdf::Exception> exceptions;  ///< checks that the model does not meet by its nature
  Diagnosis diagnosis;                      ///< where a check failed that is no exception
  double seconds = 0;                       ///< wall clock of all checks

  /// The exception that excuses a check; null: none.
  const bsdf::Exception* stated(const Verdict& verdict) const;
  /// Whether every check passed, was skipped, or failed as stated.
  bool sound() const;
};

/// All checks of a subject, and a diagnosis where one fails that is not excused.
Report check_subject(const Subject& subject, std::vector<bsdf::Exception> exceptions, const Options& options,
                     Progress& progress);

/// One line a check: its name, "pass", "FAIL", "stated" or "-", measured and allowed, words.
std::string to_text(const Report& report);
/// One row a subject: the word of each check, and the seconds that they took together.
std::string to_table(std::span<const Report> reports);
/// An array of objects: model, sound, seconds, cause, cause_words, checks (check, verdict, measured, allowed, at_least,
/// words, exception).
std::string to_json(std::span<const Report> reports);

/// A subject without parameters, from its callbacks; `white`: it absorbs nothing.
Subject fixed_subject(const Scatterer& scatterer, bool near_field, bool white, bool complete);

}  // namespace cuticle::study::model_check
