// The study of motion in its quick form.
#include "study/motion/motion_study.h"

#include <cstdio>
#include <iterator>

#include <gtest/gtest.h>

#include "study/engine/run.h"

namespace cuticle::study::motion_study_test {
namespace {

TEST(MotionStudy, Quick_MoreSubstepsBringSolversNearerAndTheCheapestIsNamed) {
  auto study = motion_study(quick_motion_request(), silent_progress());
  ASSERT_TRUE(study.ok());
  study->timing = {.rounds = 1, .sample_seconds = 1e-5};
  const StudyResult result = *run_study(*study, silent_progress());
  ASSERT_EQ(result.groups.size(), 4u);
  for (std::size_t g = 0; g < 4; ++g) {
    const auto& points = result.groups[g].points;
    ASSERT_EQ(points.size(), 3u * 2);  // solvers, substeps
    for (std::size_t k = 0; k < points.size(); k += 2) {
      const PointResult &few = points[k], &many = points[k + 1];
      ASSERT_EQ(few.method, many.method);
      if (g == 0) {
        EXPECT_LT(many.metrics[0].all.mean.value, few.metrics[0].all.mean.value) << few.method;
      }
      if (few.method != "classic") {
        EXPECT_LT(many.metrics[2].all.mean.value, 1e-5) << study->groups[g].name;
      }
    }
  }
  const Json swing = conclusions_json(*study, result)["groups"][0];
  EXPECT_FALSE(swing["cheapest_for"].empty());
  for (const Json& step : swing["cheapest_for"]) {
    EXPECT_GE(step["error_at_most"].number(), study->groups[0].floor);  // below it nothing is told
    if (!step["choice"].is_null()) {
      EXPECT_LE(step["choice"]["choosing_error"].number(), step["error_at_most"].number());
    }
  }
}

/// The largest error at 1/480 s, and what it is at 1/120 s over that at 1/480 s, at least.
struct Bound {
  double fine, falls;
};

// In the order of run_motion_truths. Where rounding or the links are what is left, nothing falls.
TEST(MotionTruths, ClosedForms_AreMetAndShorterStepsAreNearer) {
  const Bound bounds[] = {{1e-4, 8}, {2e-4, 8},  {3.5e-4, 3}, {1e-4, 0},   {3e-5, 0},
                          {1e-3, 8}, {1e-3, 15}, {0.03, 0},   {3e-4, 0.9}, {1.4e-3, 0.9}};
  const auto rows = run_motion_truths({1.0 / 480, 1.0 / 120});
  ASSERT_TRUE(rows.ok()) << rows.error().message;
  ASSERT_EQ(rows->size(), 2 * std::size(bounds));
  for (std::size_t k = 0; k < std::size(bounds); ++k) {
    const TruthRow &fine = (*rows)[2 * k], &coarse = (*rows)[2 * k + 1];
    std::printf("%-45s %-8s %.2e at 1/480 s, %.2e at 1/120 s\n", fine.truth.c_str(), fine.solver.c_str(), fine.error,
                coarse.error);
    EXPECT_LT(fine.error, bounds[k].fine) << fine.truth;
    EXPECT_GT(coarse.error, bounds[k].falls * fine.error) << fine.truth;
  }
}

}  // namespace
}  // namespace cuticle::study::motion_study_test
