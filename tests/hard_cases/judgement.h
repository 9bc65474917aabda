#pragma once
// What a case's values are held against.
#include <string>

#include "core/json/json.h"
#include "tests/hard_cases/subject.h"

namespace cuticle::hard_cases {

/// What became of the values of one case.
struct Judgement {
  std::string complaint;       ///< empty: everything held
  double used = 0;             ///< the largest share of an allowed error that was used; above 1 the case failed
  std::size_t not_finite = 0;  ///< values that are infinite or NaN
};

/// Holds values against what the case expects; `exact`: the same values in the most exact precision.
Judgement judge(const Values& values, const Json& expect, Precision precision, const Values& exact);
/// Holds an error that came against the one that the case expects.
Judgement judge(const Error& error, const Json& expect);

}  // namespace cuticle::hard_cases
