#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/registry/parameter.h"

namespace cuticle::registry::parameter_degrees_test {
namespace {

using ::testing::HasSubstr;

constexpr Parameter k_table[] = {
    {"alpha", ParameterType::real, "rad", -0.17453292519943295, 0.17453292519943295, "0", {}, "tilt"},
    {"eta", ParameterType::real, "1", 1, 3, "1.55", {}, "index of refraction"},
};

TEST(ParameterDegrees, AngleInDegrees_BecomesRadians) {
  EXPECT_DOUBLE_EQ(parse_assignments(k_table, "alpha_deg=-7.5")->real("alpha"), -0.1308996938995747);
}

TEST(ParameterDegrees, EndOfTheRange_IsInside) {
  EXPECT_EQ(parse_assignments(k_table, "alpha_deg=10")->real("alpha"), 0.17453292519943295);
}

TEST(ParameterDegrees, OutOfRange_IsRefusedInDegrees) {
  const auto refused = parse_assignments(k_table, "alpha_deg=11");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("alpha_deg"), HasSubstr("11"), HasSubstr("-10 .. 10 deg")));
}

TEST(ParameterDegrees, DegreesTypedAsRadians_AreHintedInBoth) {
  const auto refused = parse_assignments(k_table, "alpha=-7.5");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().hint, "-7.5 degrees is alpha_deg=-7.5 or alpha=-0.1309");
}

TEST(ParameterDegrees, OutOfRangeInDegreesToo_HintsTheDefault) {
  EXPECT_EQ(parse_assignments(k_table, "alpha=-75").error().hint, "alpha=0");
}

TEST(ParameterDegrees, ParameterThatIsNoAngle_HasNoDegrees) {
  EXPECT_FALSE(parse_assignments(k_table, "eta_deg=1.5").ok());
}

}  // namespace
}  // namespace cuticle::registry::parameter_degrees_test
