#include "tests/hard_cases/hard_case_runner.h"

#include <chrono>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "tests/hard_cases/catalogue.h"
#include "tests/hard_cases/judgement.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

constexpr Precision k_precisions[] = {Precision::f64, Precision::f32, Precision::gpu};

Run run_of(const Case& item, Precision precision) {
  for (const Subject& subject : subjects())
    if (subject.name == item.subject) return subject.run[std::size_t(precision)];
  return nullptr;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Verdict with_judgement(Verdict verdict, const Judgement& judgement) {
  verdict.state = judgement.complaint.empty() ? State::passed : State::failed;
  verdict.detail = judgement.complaint;
  verdict.used = judgement.used;
  verdict.not_finite = judgement.not_finite;
  return verdict;
}

/// Runs one case in one precision; `exact` receives the values of the first precision, the most exact one.
Verdict run_case(const Case& item, Precision precision, GpuSession* session, Values& exact) {
  Verdict verdict{.id = item.id,
                  .family = item.family,
                  .subject = item.subject,
                  .why = item.why,
                  .source = item.source,
                  .precision = precision,
                  .detail = {}};
  const Run run = run_of(item, precision);
  if (run == nullptr || (precision == Precision::gpu && session == nullptr)) return verdict;
  const auto begin = std::chrono::steady_clock::now();
  const Result<Values> values = run(item.inputs, session);
  verdict.seconds = seconds_since(begin);
  if (exact.empty() && values) exact = *values;
  if (!values && precision == Precision::gpu && item.expect.contains("cpu_alone")) return verdict;
  return with_judgement(verdict,
                        values ? judge(*values, item.expect, precision, exact) : judge(values.error(), item.expect));
}

std::vector<Verdict> run_cases(const std::vector<Case>& cases, GpuSession* session, Progress& progress) {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Values exact;
    for (Precision precision : k_precisions) verdicts.push_back(run_case(cases[i], precision, session, exact));
    progress.update("hard cases", i + 1, cases.size());
  }
  return verdicts;
}

Result<std::vector<Verdict>> run_all(const std::vector<Case>& cases,
                                     [[maybe_unused]] const std::shared_ptr<gpu::Device>& device, Progress& progress) {
  try {
#ifdef CUTICLE_HAS_GPU
    GpuSession session{device, {}, {}};
    return run_cases(cases, device ? &session : nullptr, progress);
#else
    return run_cases(cases, nullptr, progress);
#endif
  } catch (const Json::Mismatch& error) {
    return internal_error(fmt::format("the catalogue of hard cases: {}", error.what()));
  }
}

std::vector<std::string> families_of(const std::vector<Case>& cases) {
  std::vector<std::string> families;
  for (const Case& item : cases)
    if (families.empty() || families.back() != item.family) families.push_back(item.family);
  return families;
}

}  // namespace

const char* name_of(Precision precision) {
  switch (precision) {
    case Precision::f32:
      return "f32";
    case Precision::f64:
      return "f64";
    case Precision::gpu:
      break;
  }
  return "gpu";
}

Result<std::vector<Verdict>> run_document(const std::string& text, const std::shared_ptr<gpu::Device>& device,
                                          Progress& progress) {
  CUTICLE_ASSIGN(const Json document, Json::parse(text));
  try {
    return run_all(cases_of(document), device, progress);
  } catch (const Json::Mismatch& error) {
    return internal_error(fmt::format("the catalogue of hard cases: {}", error.what()));
  }
}

Result<std::vector<Verdict>> run_hard_cases(const Choice& choice, const std::shared_ptr<gpu::Device>& device,
                                            Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<Case> cases, all_cases());
  std::vector<Case> chosen;
  for (const Case& item : cases)
    if ((choice.family.empty() || item.family == choice.family) && (choice.full || !item.full)) chosen.push_back(item);
  if (chosen.empty())
    return usage_error(fmt::format("no hard case is of the family '{}'", choice.family),
                       fmt::format("one of {}", fmt::join(families_of(cases), ", ")));
  return run_all(chosen, device, progress);
}

}  // namespace cuticle::hard_cases
