#pragma once
// The catalogue as data: catalogue/*.json, compiled in, one document a family.
#include <string>
#include <vector>

#include "core/json/json.h"

namespace cuticle::hard_cases {

/// One case, with what its family's document says for all of them filled in.
struct Case {
  std::string id, family, subject;
  std::string why;     ///< what makes it hard
  std::string source;  ///< where the difficulty is described: a paper, a standard, a report
  bool full = false;   ///< takes seconds: runs where everything is asked for
  Json inputs, expect;
};

/// The cases of one document: {"family", "source" (of cases that name none), "grooms": {name: groom}, "cases": [...]};
/// a case's "groom" may be one of these names. Throws Json::Mismatch.
std::vector<Case> cases_of(const Json& document);

/// Every case of the catalogue. Errors: internal, naming the document that cannot be read.
Result<std::vector<Case>> all_cases();

}  // namespace cuticle::hard_cases
