// Tables of scheuermann, against the model itself.
#include <gtest/gtest.h>

#include "lut/comparison.h"
#include "lut/format.h"

namespace cuticle::lut::half_vector::lut_half_vector_test {
namespace {

struct Errors {
  double rms = 0, maximum = 0;
};
Errors errors_of(const char* settings) {
  const bsdf::Model& model = **bsdf::find_model("scheuermann");
  const auto values = bsdf::parse_settings(model, "", settings).value();
  TableSet set = *bake(model, values, **find_layout("auto", model, values), 128, silent_progress());
  EXPECT_EQ(set.layout->entry.name, "half_vector");
  EXPECT_TRUE(store_as(set, half_exr()).ok());
  EXPECT_TRUE(certify_scattering(cpu_source(model, values), set).ok());
  Errors worst;
  for (const ChannelError& stored : set.scattering) {
    worst.rms = std::max(worst.rms, relative_error(stored.rms, stored.signal_rms));
    worst.maximum = std::max(worst.maximum, relative_error(stored.maximum, stored.peak));
  }
  std::printf("%s: %.2e rms, %.2e of the peak\n", settings, worst.rms, worst.maximum);
  return worst;
}

TEST(LayoutHalfVector, AsItIsByDefault_IsWithinItsMeasuredError) {
  const Errors errors = errors_of("");
  EXPECT_LT(errors.rms, 0.005);
  EXPECT_LT(errors.maximum, 0.005);
}

TEST(LayoutHalfVector, OtherModels_AreRefusedByName) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto refused = bake(model, bsdf::parse_settings(model, "", "").value(), **find_layout("half_vector"), 16,
                            silent_progress());
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("model scheuermann alone"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace cuticle::lut::half_vector::lut_half_vector_test
