#include "tests/hard_cases/search/space.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include <fmt/core.h>

#include "tests/hard_cases/judgement.h"
#include "tests/hard_cases/subject.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();

bool is_refusal(const Error& error) { return error.kind == ErrorKind::usage || error.kind == ErrorKind::bad_input; }

double used_by(const Result<Values>& values, const Json& expect, Precision precision, const Values& exact) {
  if (!values) return is_refusal(values.error()) ? 0 : k_infinite;
  const Judgement judgement = judge(*values, expect, precision, exact);
  const bool by_how_much = judgement.complaint.empty() || (judgement.not_finite == 0 && judgement.used > 1);
  return by_how_much ? judgement.used : k_infinite;
}

const Subject& subject_named(const std::string& name) {
  return *std::ranges::find(subjects(), std::string_view(name), &Subject::name);
}

}  // namespace

bool is_sweep() { return std::getenv("CUTICLE_SWEEPS") != nullptr; }

double share_used(const Json& item) {
  const Subject& subject = subject_named(item.at("subject").text());
  Values exact;
  double used = 0;
  for (Precision precision : {Precision::f64, Precision::f32}) {
    const Run run = subject.run[std::size_t(precision)];
    if (run == nullptr) continue;
    const Result<Values> values = run(item.at("inputs"), nullptr);
    if (exact.empty() && values) exact = *values;
    used = std::max(used, used_by(values, item.at("expect"), precision, exact));
  }
  return used;
}

bool is_refused(const Json& item) {
  for (const Run run : subject_named(item.at("subject").text()).run) {
    if (run == nullptr) continue;
    const Result<Values> values = run(item.at("inputs"), nullptr);
    return !values && is_refusal(values.error());
  }
  return false;
}

double error_at(const Space& space, const Place& place) {
  return space.error ? space.error(place) : share_used(space.case_at(place));
}

std::string catalogue_text(const Space& space, const Place& place, double error) {
  Json item{{"id", "found-" + space.name},
            {"why", fmt::format("found by search: {:.3g} where {:.3g} is allowed", error, space.at_most)},
            {"source", "found by search_test"}};
  item.update(space.case_at(place));
  return item.dump();
}

std::vector<Space> spaces() {
  std::vector<Space> all;
  for (auto* some : {function_spaces, float_spaces, model_spaces, table_spaces, shadow_spaces, motion_spaces,
                     strand_spaces, drawing_spaces, fit_spaces})
    for (Space& space : some()) all.push_back(std::move(space));
  return all;
}

}  // namespace cuticle::hard_cases::search
