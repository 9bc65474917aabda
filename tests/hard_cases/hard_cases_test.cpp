// The whole catalogue in every precision, and the runner itself on small catalogues with a known verdict.
#include <cstdlib>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hard_cases/catalogue.h"
#include "tests/hard_cases/hard_case_runner.h"
#ifdef CUTICLE_HAS_GPU
#include "gpu/tests/test_device.h"
#endif

namespace cuticle::hard_cases::hard_cases_test {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<gpu::Device> device() {
#ifdef CUTICLE_HAS_GPU
  return tests::device();
#else
  return nullptr;
#endif
}

std::vector<std::string> families() {
  std::set<std::string> names;
  const std::vector<Case> cases = all_cases().value();
  for (const Case& item : cases) names.insert(item.family);
  return {names.begin(), names.end()};
}

/// With the sweeps (scripts/test.sh --full), the cases that take seconds too. mutate.py runs one family at a time.
class HardCasesOf : public testing::TestWithParam<std::string> {};

TEST_P(HardCasesOf, EveryCaseInEveryPrecision_Holds) {
  static const std::shared_ptr<gpu::Device> shared = device();
  const Choice choice{.family = GetParam(), .full = std::getenv("CUTICLE_SWEEPS") != nullptr};
  const std::vector<Verdict> verdicts = run_hard_cases(choice, shared, silent_progress()).value();
  EXPECT_FALSE(verdicts.empty());
  for (const Verdict& verdict : verdicts)
    EXPECT_NE(verdict.state, State::failed)
        << verdict.id << " in " << name_of(verdict.precision) << ": " << verdict.detail;
}
INSTANTIATE_TEST_SUITE_P(Families, HardCasesOf, testing::ValuesIn(families()),
                         [](const auto& tested) { return tested.param; });

TEST(HardCases, Catalogue_HoldsCasesUnderNamesOfTheirOwnWithTheirSources) {
  const std::vector<Case> cases = all_cases().value();
  std::multiset<std::string> ids;
  std::map<std::string, int> of_family;
  for (const Case& item : cases) {
    ids.insert(item.id);
    ++of_family[item.family];
    EXPECT_FALSE(item.why.empty() || item.source.empty()) << item.id;
  }
  EXPECT_GE(ids.size(), 400u);
  EXPECT_GE(of_family["drawing"], 60);
  EXPECT_GE(of_family["motion"], 60);
  for (const std::string& id : ids) EXPECT_EQ(ids.count(id), 1u) << id;
}

TEST(HardCases, OfOneFamily_AreThoseOfTheCatalogue) {
  const std::vector<Verdict> chosen = run_hard_cases({.family = "functions"}, nullptr, silent_progress()).value();
  for (const Verdict& verdict : chosen) EXPECT_EQ(verdict.family, "functions");
  const auto refused = run_hard_cases({.family = "nonsense"}, nullptr, silent_progress());
  EXPECT_EQ(refused.error().kind, ErrorKind::usage);
  EXPECT_THAT(refused.error().hint, HasSubstr("functions, "));
}

Verdict verdict_of(const std::string& expect) {
  const std::string text =
      R"({"cases": [{"id": "x", "subject": "function", "why": "a test", "inputs": {"function": "exp", "x": 1},
    "expect": )" +
      expect + "}]}";
  return run_document(text, nullptr, silent_progress()).value().front();
}

TEST(HardCaseRunner, ValueWithinTolerance_Passes) {
  EXPECT_EQ(verdict_of(R"({"value": 2.718281828459045, "relative": {"f64": 1e-15}})").state, State::passed);
}

TEST(HardCaseRunner, ValueOutsideTolerance_FailsAndSaysBoth) {
  const Verdict verdict = verdict_of(R"({"value": 2.7, "relative": 1e-3})");
  EXPECT_EQ(verdict.state, State::failed);
  EXPECT_THAT(verdict.detail, HasSubstr("2.7182818"));
}

TEST(HardCaseRunner, ValueOffByHalfOfWhatIsAllowed_UsesHalf) {
  EXPECT_NEAR(verdict_of(R"({"value": 2.718281828459045, "absolute": 0, "relative": 1})").used, 0, 1e-12);
  EXPECT_NEAR(verdict_of(R"({"value": 2.218281828459045, "absolute": 1})").used, 0.5, 1e-12);
}

TEST(HardCaseRunner, ValueOutsideBounds_Fails) { EXPECT_EQ(verdict_of(R"({"bounds": [0, 1]})").state, State::failed); }

TEST(HardCaseRunner, ErrorThatDoesNotCome_Fails) {
  EXPECT_EQ(verdict_of(R"({"error": "bad_input"})").state, State::failed);
}

TEST(HardCaseRunner, NotANumber_Fails) {
  const auto verdicts = run_document(R"({"cases": [{"id": "x", "subject": "function", "why": "a test",
    "inputs": {"function": "sin", "x": "nan"}, "expect": {}}]})",
                                     nullptr, silent_progress())
                            .value();
  EXPECT_EQ(verdicts.front().state, State::failed);
  EXPECT_EQ(verdicts.front().not_finite, 1u);
}

TEST(HardCaseRunner, BrokenCatalogue_IsAnError) {
  EXPECT_FALSE(run_document("{", nullptr, silent_progress()));
  EXPECT_FALSE(run_document(R"({"cases": [{"id": "x"}]})", nullptr, silent_progress()));
}

}  // namespace
}  // namespace cuticle::hard_cases::hard_cases_test
