// The study of motion in its quick form.
#include <cuticle/study/motion/motion_study.h>

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

}  // namespace
}  // namespace cuticle::study::motion_study_test
