#include "tests/hard_cases/hard_case_runner.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "core/json/json.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {

/// The text of hard_cases.json, written into the build by CMake.
extern const char* const k_catalogue_text;

namespace {

constexpr Precision k_precisions[] = {Precision::f64, Precision::f32, Precision::gpu};

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage: return "usage";
    case ErrorKind::bad_input: return "bad_input";
    case ErrorKind::no_device: return "no_device";
    case ErrorKind::out_of_memory: return "out_of_memory";
    case ErrorKind::internal: break;
  }
  return "internal";
}

/// A tolerance: one number, or one per precision ({"f32": 1e-6, ...}); 0 where it is not given.
double tolerance(const Json& expect, const char* key, Precision precision) {
  if (!expect.contains(key)) return 0;
  const Json& value = expect.at(key);
  return value.is_object() ? value.value(name_of(precision), 0.0) : value.number();
}

/// What is wrong with the values, or nothing.
using Complaint = std::optional<std::string>;

Complaint finite(const Values& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) return fmt::format("value {} of {} is {}", i + 1, values.size(), values[i]);
  return {};
}

Complaint equal_to_reference(const Values& values, const Json& expect, Precision precision) {
  if (!expect.contains("value")) return {};
  const double reference = expect.at("value").number();
  const double allowed = tolerance(expect, "absolute", precision) + tolerance(expect, "relative", precision) * std::abs(reference);
  for (double value : values)
    if (!(std::abs(value - reference) <= allowed)) return fmt::format("{} is not {} +- {:.3g}", value, reference, allowed);
  return {};
}

Complaint within_bounds(const Values& values, const Json& expect) {
  if (!expect.contains("bounds")) return {};
  const double lower = expect.at("bounds").at(0).number(), upper = expect.at("bounds").at(1).number();
  for (double value : values)
    if (!(value >= lower && value <= upper)) return fmt::format("{} is outside {} .. {}", value, lower, upper);
  return {};
}

/// Agreement with f64 (or f32, where there is no f64), relative to the largest value of the case.
Complaint agreeing(const Values& values, const Json& expect, Precision precision, const Values& exact) {
  if (!expect.contains("agree") || values.size() != exact.size()) return {};
  double scale = 0, worst = 0;
  for (double value : exact) scale = std::max(scale, std::abs(value));
  for (std::size_t i = 0; i < values.size(); ++i) worst = std::max(worst, std::abs(values[i] - exact[i]));
  const double allowed = tolerance(expect, "agree", precision);
  if (worst <= allowed * scale) return {};
  return fmt::format("off the CPU by {:.3g} of the largest value, allowed {:.3g}", worst / scale, allowed);
}

Complaint counted(const Values& values, const Json& expect) {
  const std::size_t count = expect.value("count", values.size());
  if (values.size() == count) return {};
  return fmt::format("{} values, expected {}", values.size(), count);
}

Complaint complaint_about(const Values& values, const Json& expect, Precision precision, const Values& exact) {
  if (expect.contains("error")) return "no error came, expected " + expect.at("error").text();
  for (const Complaint& complaint : {finite(values), counted(values, expect), equal_to_reference(values, expect, precision),
                                     within_bounds(values, expect), agreeing(values, expect, precision, exact)})
    if (complaint) return complaint;
  return {};
}

Complaint complaint_about(const Error& error, const Json& expect) {
  if (expect.value("error", std::string()) == name_of(error.kind)) return {};
  return fmt::format("{} error: {}", name_of(error.kind), error.message);
}

Run run_of(const Json& item, Precision precision) {
  for (const Subject& subject : subjects())
    if (subject.name == item.at("subject").text()) return subject.run[std::size_t(precision)];
  return nullptr;
}

/// Runs one case in one precision; `exact` receives the values of the first precision, the most exact one.
Verdict run_case(const Json& item, Precision precision, GpuSession* session, Values& exact) {
  Verdict verdict{
      item.at("id").text(), item.at("subject").text(), item.at("why").text(), precision, State::not_applicable, {}};
  const Run run = run_of(item, precision);
  if (run == nullptr || (precision == Precision::gpu && session == nullptr)) return verdict;
  const Result<Values> values = run(item.at("inputs"), session);
  if (exact.empty() && values) exact = *values;
  const Json& expect = item.at("expect");
  if (!values && precision == Precision::gpu && expect.contains("cpu_alone")) return verdict;
  const Complaint complaint = values ? complaint_about(*values, expect, precision, exact) : complaint_about(values.error(), expect);
  verdict.state = complaint ? State::failed : State::passed;
  verdict.detail = complaint.value_or("");
  return verdict;
}

std::vector<Verdict> run_all(const Json& cases, GpuSession* session, Progress& progress) {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Values exact;
    for (Precision precision : k_precisions) verdicts.push_back(run_case(cases[i], precision, session, exact));
    progress.update("hard cases", i + 1, cases.size());
  }
  return verdicts;
}

}  // namespace

const char* name_of(Precision precision) {
  switch (precision) {
    case Precision::f32: return "f32";
    case Precision::f64: return "f64";
    case Precision::gpu: break;
  }
  return "gpu";
}

Result<std::vector<Verdict>> run_catalogue(const std::string& text, [[maybe_unused]] const std::shared_ptr<gpu::Device>& device,
                                          Progress& progress) {
  try {
    CUTICLE_ASSIGN(const Json catalogue, Json::parse(text));
#ifdef CUTICLE_HAS_GPU
    GpuSession session{device, {}};
    return run_all(catalogue.at("cases"), device ? &session : nullptr, progress);
#else
    return run_all(catalogue.at("cases"), nullptr, progress);
#endif
  } catch (const Json::Mismatch& error) {
    return internal_error(fmt::format("the catalogue of hard cases: {}", error.what()));
  }
}

Result<std::vector<Verdict>> run_hard_cases(const std::string& subject, const std::shared_ptr<gpu::Device>& device, Progress& progress) {
  if (subject.empty()) return run_catalogue(k_catalogue_text, device, progress);
  CUTICLE_ASSIGN(const Json catalogue, Json::parse(k_catalogue_text));
  Json chosen = Json::list();
  for (const Json& item : catalogue["cases"])
    if (item["subject"] == subject) chosen.push_back(item);
  if (chosen.empty()) return usage_error(fmt::format("no hard case is about '{}'", subject), "cuticle check device lists the subjects");
  return run_catalogue(Json{{"cases", chosen}}.dump(), device, progress);
}

}  // namespace cuticle::hard_cases
