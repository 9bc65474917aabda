// Layouts that suit few models, against these.
#include <cstdio>

#include <gtest/gtest.h>

#include "lut/comparison.h"
#include "lut/format.h"

namespace cuticle::lut::lut_own_layout_test {
namespace {

/// Bounds of S: rms over rms, and the largest error over the peak.
struct Case {
  const char *model, *settings, *layout;
  int size;
  double rms, of_peak;
};
/// Measured: .15 % rms and .45 % of the peak; .03 and .10 %; at 64 x 64 .28 and .17 %; .13 and .16 %; .27 and .26 %.
constexpr Case k_cases[] = {{"karis", "", "karis", 128, 0.002, 0.006},
                            {"scheuermann", "", "half_vector", 128, 0.0004, 0.0013},
                            {"yan_fur", "azimuthal_tolerance=1e-3,sigma_a=0.1/0.2/0.4", "yan_fur", 64, 0.0035, 0.0025},
                            {"chiang", "field=far", "chiang", 128, 0.0016, 0.002},
                            {"deon", "azimuthal_tolerance=1e-3", "chiang", 128, 0.0035, 0.0035}};
class OwnLayout : public testing::TestWithParam<Case> {};

TEST_P(OwnLayout, OfAModel_IsChosenAndWithinItsMeasuredError) {
  const Case& each = GetParam();
  const bsdf::Model& model = **bsdf::find_model(each.model);
  const auto values = bsdf::parse_settings(model, "", each.settings).value();
  TableSet set = *bake(model, values, **find_layout("auto", model, values), each.size, silent_progress());
  EXPECT_EQ(set.layout->entry.name, each.layout);
  ASSERT_TRUE(store_as(set, half_exr()).ok());
  ASSERT_TRUE(certify_scattering(cpu_source(model, values), set).ok());
  for (const ChannelError& left_out : set.assumption)
    EXPECT_LT(relative_error(left_out.rms, left_out.signal_rms), 1e-8);
  for (const ChannelError& stored : set.scattering) {
    const double rms = relative_error(stored.rms, stored.signal_rms), most = relative_error(stored.maximum, stored.peak);
    std::printf("%s: %.2e rms, %.2e of the peak\n", each.layout, rms, most);
    EXPECT_LT(rms, each.rms);
    EXPECT_LT(most, each.of_peak);
  }
}

TEST_P(OwnLayout, OfAnotherModel_IsRefusedByName) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto refused = bake(model, bsdf::parse_settings(model, "", "").value(), **find_layout(GetParam().layout), 16,
                            silent_progress());
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find(GetParam().layout), std::string::npos) << refused.error().message;
}
INSTANTIATE_TEST_SUITE_P(Layouts, OwnLayout, testing::ValuesIn(k_cases),
                         [](const auto& info) { return std::string(info.param.model); });

}  // namespace
}  // namespace cuticle::lut::lut_own_layout_test
