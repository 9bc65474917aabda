// The study of motion in its quick form.
#include "study/motion/motion_study.h"

#include <cstdio>
#include <iterator>

#include <gtest/gtest.h>

namespace cuticle::study::motion_study_test {
namespace {

TEST(MotionStudy, Quick_MoreSubstepsBringSolversNearerAndTheCheapestIsNamed) {
  const auto study = run_motion_study(quick_motion_request(), silent_progress());
  ASSERT_TRUE(study.ok());
  ASSERT_EQ(study->rows.size(), 4u * 3 * 2);  // cases, solvers, substeps
  for (std::size_t k = 0; k < study->rows.size(); k += 2) {
    const MotionRow &few = study->rows[k], &many = study->rows[k + 1];
    ASSERT_EQ(few.solver, many.solver);
    if (few.scene == "swing") {
      EXPECT_LT(many.error, few.error) << few.solver;
    }
    if (few.solver != "classic") {
      EXPECT_LT(many.largest_stretch, 1 + 1e-5) << few.scene;
    }
  }
  const MotionRow* found = cheapest(*study, "swing", 0.05);
  ASSERT_NE(found, nullptr);
  EXPECT_LE(found->error, 0.05);
  EXPECT_EQ(cheapest(*study, "swing", 1e-9), nullptr);
  MotionStudy unknown = *study;
  unknown.reference_change["swing"] = 0.06;
  EXPECT_EQ(cheapest(unknown, "swing", 0.05), nullptr);
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
