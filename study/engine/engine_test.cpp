// A study of a known integral: its errors, its times on an idle and on a busy machine, and its files.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "core/file.h"
#include "study/engine/compare.h"
#include "study/engine/run.h"

namespace cuticle::study::engine_test {
namespace {

/// The midpoint rule for the integral of exp(k x) over 0 .. 1.
double midpoint(double k, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += std::exp(k * (i + 0.5) / steps) / steps;
  return sum;
}

struct Rule {
  std::string name;
  int slowness = 1;     ///< so many times as long it takes
  double mistake = 0;  ///< added
};

Point point_of(const Rule& rule, int steps) {
  const auto measure = [rule, steps]() -> Result<Measured> {
    std::vector<double> errors;
    for (int item = 1; item <= 40; ++item) {
      const double k = 0.1 * item, exact = std::expm1(k) / k;
      errors.push_back((midpoint(k, steps) + rule.mistake) / exact - 1);
    }
    return Measured{{errors}};
  };
  const auto run = [rule, steps]() -> Result<void> {
    volatile double sink = 0;
    constexpr int k_repeats = 100;  // so that the sums outweigh the cost of the call, under sanitizers too
    for (int k = 0; k < k_repeats * rule.slowness; ++k) sink = midpoint(1.5, steps);
    static_cast<void>(sink);
    return {};
  };
  return {rule.name, {{"steps", std::to_string(steps)}}, measure, {{}, run, 1}};
}

Study study_of(const std::vector<Rule>& rules) {
  Study study{.name = "integral", .title = "t", .question = "q"};
  study.timing = {.rounds = 9, .sample_seconds = 5e-4};
  study.groups = {{.name = "exp", .title = "t", .truth = "the integral", .metrics = {{"integral", "relative error"}}}};
  for (const Rule& rule : rules)
    for (int steps : {8, 32, 128}) study.groups[0].points.push_back(point_of(rule, steps));
  return study;
}

struct Made {
  Study study;
  StudyResult result;
};
Made run_of(const std::vector<Rule>& rules) {
  Made run{study_of(rules), {}};
  run.result = *run_study(run.study, silent_progress());
  return run;
}

/// "A before B" of all that is claimed in time and in error.
std::set<std::string> claims(const Made& made) {
  const Json conclusions = conclusions_json(made.study, made.result);
  std::set<std::string> claims;
  for (const char* kind : {"faster", "more_exact"})
    for (const Json& pair : conclusions["groups"][0]["rankings"][kind])
      claims.insert(std::string(kind) + " " + pair[0].text() + " " + pair[1].text());
  return claims;
}

TEST(Engine, MidpointRule_ErrorsFallWithTheSquareOfTheCost) {
  Made run = run_of({{"midpoint"}});
  auto& points = run.result.groups[0].points;
  EXPECT_NEAR(points[0].metrics[0].all.mean.value / points[1].metrics[0].all.mean.value, 16, 0.3);
  // The cost by the count of steps: times of a busy machine are not in proportion to it.
  for (auto& point : points) point.time.units.value = std::strtod(point.knobs[0].value.c_str(), nullptr);
  const Json exponents = conclusions_json(run.study, run.result)["groups"][0]["exponents"];
  ASSERT_EQ(exponents.size(), 1u);
  EXPECT_NEAR(exponents[0]["exponent"].number(), -2, 0.02);
}

TEST(Engine, ASlowedAndAWrongMethod_ShowAsSuch) {
  const Made run = run_of({{"midpoint"}, {"slow", 3}, {"wrong", 1, 0.01}});
  const std::set<std::string> claimed = claims(run);
  const Json front = conclusions_json(run.study, run.result)["groups"][0]["front"];
  for (const Json& point : front) EXPECT_TRUE(!point["on_front"].boolean() || !point["point"].text().starts_with("slow"));
  // A wrong method whose error no number of steps lowers is beaten for certain by the one with fewer steps.
  for (const Json& point : front) EXPECT_NE(point["point"].text(), "wrong steps=128");
  const auto& points = run.result.groups[0].points;
  EXPECT_TRUE(is_below(points[2].time.units, points[5].time.units));
  EXPECT_TRUE(is_below(points[2].metrics[0].all.mean, points[8].metrics[0].all.mean));
  EXPECT_TRUE(claimed.contains("faster midpoint steps=8 midpoint steps=32"));
}

TEST(Engine, ABusyMachine_ClaimsContradictNothingOfTheIdleOne) {
  const std::vector<Rule> rules = {{"midpoint"}, {"slow", 2}, {"same"}};
  const std::set<std::string> idle = claims(run_of(rules));
  std::atomic<bool> stop = false;
  std::vector<std::thread> others;
  for (int k = 0; k < 3; ++k)
    others.emplace_back([&stop] {
      while (!stop) {
        volatile double sink = midpoint(1, 1000);
        static_cast<void>(sink);
      }
    });
  // The burning threads are in this process, so its processor time counts them: wall clock is what is left.
  Made busy{study_of(rules), {}};
  busy.study.wall_clock = true;
  busy.result = *run_study(busy.study, silent_progress());
  stop = true;
  for (std::thread& other : others) other.join();
  for (const std::string& claim : claims(busy)) {
    std::string kind, a, steps_a, b, steps_b;
    std::istringstream(claim) >> kind >> a >> steps_a >> b >> steps_b;
    EXPECT_FALSE(idle.contains(kind + " " + b + " " + steps_b + " " + a + " " + steps_a)) << claim;
  }
}

TEST(Engine, Files_OfTwoRuns_DifferInTimesAlone) {
  const std::string folder = ::testing::TempDir() + "/engine_test";
  for (const char* run : {"/a", "/b"}) {
    const Made made = run_of({{"midpoint"}});
    ASSERT_TRUE(write_study(made.study, made.result, "cuticle study integral --out DIR", folder + run));
  }
  for (const char* file : {"/result.json", "/study.csv"})
    EXPECT_EQ(*read_text_file(folder + "/a" + file), *read_text_file(folder + "/b" + file)) << file;
  const Json times = Json::parse(*read_text_file(folder + "/a/times.json")).value();
  EXPECT_EQ(times["groups"][0]["points"].size(), 3u);
  EXPECT_FALSE(times["machine"]["processor"].text().empty());
}

TEST(CompareStudies, ASlowerAndALessExactResult_AreNamed) {
  const std::string folder = ::testing::TempDir() + "/compare_test";
  const Made before = run_of({{"midpoint"}}), slow = run_of({{"midpoint", 4}}), wrong = run_of({{"midpoint", 1, 0.5}});
  ASSERT_TRUE(write_study(before.study, before.result, "", folder + "/before"));
  ASSERT_TRUE(write_study(slow.study, slow.result, "", folder + "/slow"));
  ASSERT_TRUE(write_study(wrong.study, wrong.result, "", folder + "/wrong"));
  const StudyComparison slower = *compare_studies(folder + "/before", folder + "/slow");
  EXPECT_EQ(std::ranges::count_if(slower.points, &ComparedPoint::slower), 3);
  EXPECT_EQ(std::ranges::count_if(slower.points, &ComparedPoint::less_exact), 0);
  const StudyComparison worse = *compare_studies(folder + "/before", folder + "/wrong");
  EXPECT_EQ(std::ranges::count_if(worse.points, &ComparedPoint::less_exact), 3);
  EXPECT_TRUE(has_regressions(slower) && has_regressions(worse));
  const StudyComparison same = *compare_studies(folder + "/before", folder + "/before");
  EXPECT_FALSE(has_regressions(same));
  EXPECT_NE(to_text(slower).find("slower in B: 3\n  integral, exp, midpoint steps=128: time"), std::string::npos);
  EXPECT_FALSE(compare_studies(folder, "/nowhere"));
}

}  // namespace
}  // namespace cuticle::study::engine_test
