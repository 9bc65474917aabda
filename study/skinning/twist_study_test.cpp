// The volume that a twist leaves, against the integral over sections.
#include "study/skinning/twist_study.h"

#include <gtest/gtest.h>

namespace cuticle::study::twist_study_test {
namespace {

TEST(TwistStudy, Volumes_AreTheAnalyticOnes) {
  const TwistStudy study = run_twist_study();
  ASSERT_EQ(study.rows.size(), 26u);
  for (const TwistRow& row : study.rows) EXPECT_NEAR(row.volume_kept, row.volume_analytic, 1e-4) << row.angle_deg;
}

TEST(TwistStudy, HalfATurn_LinearBlendCollapsesInTheMiddleAndDualQuaternionsDoNot) {
  const TwistStudy study = run_twist_study();
  const TwistRow &linear = study.rows[24], &dual = study.rows[25];
  EXPECT_EQ(linear.angle_deg, 180);
  EXPECT_NEAR(linear.volume_kept, 1.0 / 3, 1e-4);
  EXPECT_LT(linear.middle_radius_kept, 1e-6);
  EXPECT_NEAR(dual.middle_radius_kept, 1, 1e-6);
  for (const SectionRow& row : study.sections) {
    EXPECT_NEAR(row.linear_blend, row.linear_analytic, 1e-5);
    EXPECT_NEAR(row.dual_quaternion, 1, 1e-5);
  }
}

}  // namespace
}  // namespace cuticle::study::twist_study_test
