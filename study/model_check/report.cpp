#include "study/model_check/report.h"

#include <algorithm>
#include <chrono>

#include <fmt/core.h>

#include "core/json/json.h"

namespace cuticle::study::model_check {
namespace {

const char* word(const Report& report, const Verdict& verdict) {
  if (verdict.state == State::skipped) return "-";
  if (verdict.state == State::passed) return "pass";
  return report.stated(verdict) ? "stated" : "FAIL";
}

std::string line(const Report& report, const Verdict& verdict) {
  std::string numbers;
  if (verdict.state != State::skipped)
    numbers = fmt::format("{:.2e} {} {:.2e}", verdict.measured, verdict.at_least ? ">=" : "<=", verdict.allowed);
  std::string text =
      fmt::format("  {:<19} {:<6} {:<20} {}\n", verdict.check, word(report, verdict), numbers, verdict.words);
  const bsdf::Exception* exception = report.stated(verdict);
  if (exception && verdict.state == State::failed)
    text += fmt::format("  {:<19} {:<6} {:<20} by its nature: {}\n", "", "", "", exception->why);
  return text;
}

Json checks_json(const Report& report) {
  Json checks = Json::list();
  for (const Verdict& verdict : report.verdicts) {
    const bsdf::Exception* exception = report.stated(verdict);
    checks.push_back({{"check", verdict.check},
                      {"verdict", word(report, verdict)},
                      {"measured", verdict.measured},
                      {"allowed", verdict.allowed},
                      {"at_least", verdict.at_least},
                      {"words", verdict.words},
                      {"exception", exception ? exception->why : ""}});
  }
  return checks;
}

}  // namespace

const bsdf::Exception* Report::stated(const Verdict& verdict) const {
  const auto found = std::find_if(exceptions.begin(), exceptions.end(),
                                  [&](const bsdf::Exception& exception) { return exception.check == verdict.check; });
  return found == exceptions.end() ? nullptr : &*found;
}

bool Report::sound() const {
  return std::none_of(verdicts.begin(), verdicts.end(),
                      [&](const Verdict& verdict) { return verdict.state == State::failed && !stated(verdict); });
}

Report check_subject(const Subject& subject, std::vector<bsdf::Exception> exceptions, const Options& options,
                     Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  Report report{subject.name, run_checks(subject, options, progress), std::move(exceptions), {}};
  if (!report.sound()) report.diagnosis = diagnose(subject, report.verdicts, options);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::string to_text(const Report& report) {
  std::string text = report.name + "\n";
  for (const Verdict& verdict : report.verdicts) text += line(report, verdict);
  if (!report.sound())
    text += fmt::format("  likely cause: {} ({})\n", name_of(report.diagnosis.cause), report.diagnosis.words);
  return text;
}

std::string to_table(std::span<const Report> reports) {
  std::string text = fmt::format("{:<34}", "model");
  for (const Check& check : checks()) text += fmt::format(" {:<11}", check.name.substr(0, check.name.find('_')));
  text += fmt::format(" {:>7}\n", "s");
  for (const Report& report : reports) {
    text += fmt::format("{:<34}", report.name);
    for (const Verdict& verdict : report.verdicts) text += fmt::format(" {:<11}", word(report, verdict));
    text += fmt::format(" {:7.1f}\n", report.seconds);
  }
  return text;
}

std::string to_json(std::span<const Report> reports) {
  Json all = Json::list();
  for (const Report& report : reports)
    all.push_back({{"model", report.name},
                   {"sound", report.sound()},
                   {"seconds", report.seconds},
                   {"cause", name_of(report.diagnosis.cause)},
                   {"cause_words", report.diagnosis.words},
                   {"checks", checks_json(report)}});
  return all.dump(2);
}

Subject fixed_subject(const Scatterer& scatterer, bool near_field, bool white, bool complete) {
  Subject subject;
  subject.name = scatterer.label;
  subject.near_field = near_field;
  subject.complete = complete;
  subject.make = [scatterer, white](const Situation& situation) -> std::optional<Scatterer> {
    if (situation.absorption == Absorption::none && !white) return {};
    return scatterer;
  };
  return subject;
}

}  // namespace cuticle::study::model_check
