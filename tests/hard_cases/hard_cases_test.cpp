// The whole catalogue in every precision, and the runner itself on small catalogues with a known verdict.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hard_cases/hard_case_runner.h"
#ifdef CUTICLE_HAS_GPU
#include "gpu/device.h"
#endif

namespace cuticle::hard_cases::hard_cases_test {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<gpu::Device> device() {
#ifdef CUTICLE_HAS_GPU
  auto opened = gpu::Device::open({.choice = "", .validation = true});
  EXPECT_TRUE(opened) << (opened ? "" : opened.error().message);
  return opened ? *opened : nullptr;
#else
  return nullptr;
#endif
}

/// Run once for all tests.
const std::vector<Verdict>& verdicts() {
  static const std::vector<Verdict> all = run_hard_cases("", device(), silent_progress()).value();
  return all;
}

TEST(HardCases, EveryCaseInEveryPrecision_Holds) {
  for (const Verdict& verdict : verdicts())
    EXPECT_NE(verdict.state, State::failed) << verdict.id << " in " << name_of(verdict.precision) << ": " << verdict.detail;
}

TEST(HardCases, Catalogue_HoldsAtLeastFortyCasesUnderNamesOfTheirOwn) {
  std::multiset<std::string> ids;
  for (const Verdict& verdict : verdicts())
    if (verdict.precision == Precision::f32) ids.insert(verdict.id);
  EXPECT_GE(ids.size(), 40u);
  for (const std::string& id : ids) EXPECT_EQ(ids.count(id), 1u) << id;
}

TEST(HardCases, OfOneSubject_AreThoseOfTheCatalogue) {
  const std::vector<Verdict> chosen = run_hard_cases("function", nullptr, silent_progress()).value();
  for (const Verdict& verdict : chosen) EXPECT_EQ(verdict.subject, "function");
  EXPECT_EQ(run_hard_cases("nonsense", nullptr, silent_progress()).error().kind, ErrorKind::usage);
}

Verdict verdict_of(const std::string& expect) {
  const std::string text = R"({"cases": [{"id": "x", "subject": "function", "why": "a test", "inputs": {"function": "exp", "x": 1},
    "expect": )" + expect + "}]}";
  return run_catalogue(text, nullptr, silent_progress()).value().front();
}

TEST(HardCaseRunner, ValueWithinTolerance_Passes) {
  EXPECT_EQ(verdict_of(R"({"value": 2.718281828459045, "relative": {"f64": 1e-15}})").state, State::passed);
}

TEST(HardCaseRunner, ValueOutsideTolerance_FailsAndSaysBoth) {
  const Verdict verdict = verdict_of(R"({"value": 2.7, "relative": 1e-3})");
  EXPECT_EQ(verdict.state, State::failed);
  EXPECT_THAT(verdict.detail, HasSubstr("2.7182818"));
}

TEST(HardCaseRunner, ValueOutsideBounds_Fails) { EXPECT_EQ(verdict_of(R"({"bounds": [0, 1]})").state, State::failed); }

TEST(HardCaseRunner, ErrorThatDoesNotCome_Fails) { EXPECT_EQ(verdict_of(R"({"error": "bad_input"})").state, State::failed); }

TEST(HardCaseRunner, NotANumber_Fails) {
  const auto verdicts = run_catalogue(R"({"cases": [{"id": "x", "subject": "function", "why": "a test",
    "inputs": {"function": "sin", "x": "nan"}, "expect": {}}]})", nullptr, silent_progress()).value();
  EXPECT_EQ(verdicts.front().state, State::failed);
}

TEST(HardCaseRunner, BrokenCatalogue_IsAnError) {
  EXPECT_FALSE(run_catalogue("{", nullptr, silent_progress()));
  EXPECT_FALSE(run_catalogue(R"({"cases": [{"id": "x"}]})", nullptr, silent_progress()));
}

}  // namespace
}  // namespace cuticle::hard_cases::hard_cases_test
