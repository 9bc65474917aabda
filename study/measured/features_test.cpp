// Published features of real fibres, and what models and walks make of them.
#include <cmath>

#include <gtest/gtest.h>

#include "study/measured/measured_study.h"

namespace cuticle::features_test {
namespace {

using study::Feature;

class PublishedFeatures : public testing::Test {
 protected:
  static void SetUpTestSuite() { features = *study::published_features(300000); }
  static const Feature& feature(const std::string& begin) {
    for (const Feature& one : features)
      if (one.what.starts_with(begin)) return one;
    ADD_FAILURE() << begin;
    return features.front();
  }
  static std::vector<Feature> features;
};
std::vector<Feature> PublishedFeatures::features;

// karis moves its lobes by angles of its own.
TEST_F(PublishedFeatures, ReflectionOffScales_StandsWhereMeasuredButForKaris) {
  for (const char* side : {"R, light at 40 degrees from the root", "R, light at 40 degrees from the tip"}) {
    const Feature& shift = feature(side);
    EXPECT_EQ(shift.predictions.size(), 7u);
    for (const Feature::Prediction& prediction : shift.predictions) {
      const double room = prediction.by == "karis" ? 2.5 : 0.5;
      EXPECT_NEAR(prediction.degrees, std::stod(shift.published), room) << prediction.by;
    }
  }
}

// Models move it by a multiple of the tilt that leaves refraction out; walks through the fibre do not.
TEST_F(PublishedFeatures, BackReflection_LiesBeyondTheMirrorDirectionOfNone) {
  for (const Feature::Prediction& prediction : feature("TRT").predictions) {
    EXPECT_GT(prediction.degrees, 25) << prediction.by;
    EXPECT_LT(prediction.degrees, 35) << prediction.by;
  }
}

TEST_F(PublishedFeatures, Glint_StandsWhereWalksHaveItRoundAndAlongBothAxes) {
  for (const char* glint :
       {"azimuth of TRT's glint, aspect 1", "azimuth of TRT's glint, aspect 0.85, seen along the major",
        "azimuth of TRT's glint, aspect 0.85, seen along the minor"}) {
    const Feature& at = feature(glint);
    ASSERT_EQ(at.predictions.size(), 2u);
    EXPECT_NEAR(at.predictions[0].degrees, at.predictions[1].degrees, 5) << glint;
  }
  for (const Feature::Prediction& prediction : feature("azimuth of TRT's glint, aspect 1").predictions)
    EXPECT_NEAR(prediction.degrees, 18.6, 1) << prediction.by;
}

TEST_F(PublishedFeatures, WidthOfR_IsThatOfMeasuredHair) {
  for (const Feature::Prediction& prediction : feature("width of R").predictions) {
    EXPECT_GE(prediction.degrees, 5) << prediction.by;
    EXPECT_LE(prediction.degrees, 10) << prediction.by;
  }
}

}  // namespace
}  // namespace cuticle::features_test
