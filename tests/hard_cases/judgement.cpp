#include "tests/hard_cases/judgement.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace cuticle::hard_cases {
namespace {

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::bad_input:
      return "bad_input";
    case ErrorKind::no_device:
      return "no_device";
    case ErrorKind::out_of_memory:
      return "out_of_memory";
    case ErrorKind::internal:
      break;
  }
  return "internal";
}

/// A tolerance: one number, or one per precision ({"f32": 1e-6, ...}); 0 where it is not given.
double tolerance(const Json& expect, const char* key, Precision precision) {
  if (!expect.contains(key)) return 0;
  const Json& value = expect.at(key);
  return value.is_object() ? value.value(hard_cases::name_of(precision), 0.0) : value.number();
}

void complain(Judgement& judgement, std::string complaint) {
  if (judgement.complaint.empty()) judgement.complaint = std::move(complaint);
}

/// An error of nothing uses nothing, whatever is allowed.
void use(Judgement& judgement, double error, double allowed) {
  if (error > 0) judgement.used = std::max(judgement.used, allowed > 0 ? error / allowed : HUGE_VAL);
}

void check_finite(Judgement& judgement, const Values& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    ++judgement.not_finite;
    complain(judgement, fmt::format("value {} of {} is {}", i + 1, values.size(), values[i]));
  }
}

void check_count(Judgement& judgement, const Values& values, const Json& expect) {
  const std::size_t count = expect.value("count", values.size());
  if (values.size() != count) complain(judgement, fmt::format("{} values, expected {}", values.size(), count));
}

void check_reference(Judgement& judgement, const Values& values, const Json& expect, Precision precision) {
  if (!expect.contains("value")) return;
  const double reference = expect.at("value").number();
  const double allowed =
      tolerance(expect, "absolute", precision) + tolerance(expect, "relative", precision) * std::abs(reference);
  for (double value : values) {
    use(judgement, std::abs(value - reference), allowed);
    if (!(std::abs(value - reference) <= allowed))
      complain(judgement, fmt::format("{} is not {} +- {:.3g}", value, reference, allowed));
  }
}

void check_bounds(Judgement& judgement, const Values& values, const Json& expect) {
  if (!expect.contains("bounds")) return;
  const double lower = expect.at("bounds").at(0).number(), upper = expect.at("bounds").at(1).number();
  for (double value : values)
    if (!(value >= lower && value <= upper))
      complain(judgement, fmt::format("{} is outside {} .. {}", value, lower, upper));
}

/// Agreement with the most exact precision, relative to the largest value of the case.
void check_agreement(Judgement& judgement, const Values& values, const Json& expect, Precision precision,
                     const Values& exact) {
  if (!expect.contains("agree") || values.size() != exact.size()) return;
  double scale = 0, worst = 0;
  for (double value : exact) scale = std::max(scale, std::abs(value));
  for (std::size_t i = 0; i < values.size(); ++i) worst = std::max(worst, std::abs(values[i] - exact[i]));
  const double allowed = tolerance(expect, "agree", precision);
  use(judgement, worst, allowed * scale);
  if (!(worst <= allowed * scale))
    complain(judgement,
             fmt::format("off the CPU by {:.3g} of the largest value, allowed {:.3g}", worst / scale, allowed));
}

}  // namespace

Judgement judge(const Values& values, const Json& expect, Precision precision, const Values& exact) {
  Judgement judgement;
  if (expect.contains("error")) complain(judgement, "no error came, expected " + expect.at("error").text());
  check_finite(judgement, values);
  check_count(judgement, values, expect);
  check_reference(judgement, values, expect, precision);
  check_bounds(judgement, values, expect);
  check_agreement(judgement, values, expect, precision, exact);
  return judgement;
}

Judgement judge(const Error& error, const Json& expect) {
  if (expect.value("error", std::string()) == name_of(error.kind)) return {};
  return {.complaint = fmt::format("{} error: {}", name_of(error.kind), error.message)};
}

}  // namespace cuticle::hard_cases
