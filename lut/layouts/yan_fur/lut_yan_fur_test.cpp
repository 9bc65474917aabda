// Tables of fur, against the model itself.
#include <gtest/gtest.h>

#include "lut/comparison.h"
#include "lut/format.h"

namespace cuticle::lut::yan_fur::lut_yan_fur_test {
namespace {

/// Measured at 64 x 64: nothing left out, .28 % rms, .17 % of the peak.
TEST(LayoutYanFur, FarFieldOfYanFur_IsWithinItsMeasuredError) {
  const bsdf::Model& model = **bsdf::find_model("yan_fur");
  const auto values = bsdf::parse_settings(model, "", "azimuthal_tolerance=1e-3,sigma_a=0.1/0.2/0.4").value();
  const Layout& layout = **find_layout("auto", model, values);
  EXPECT_EQ(layout.entry.name, "yan_fur");
  TableSet set = *bake(model, values, layout, 64, silent_progress());
  ASSERT_TRUE(store_as(set, half_exr()).ok());
  ASSERT_TRUE(certify_scattering(cpu_source(model, values), set).ok());
  for (std::size_t c = 0; c < 3; ++c) {
    const ChannelError &left_out = set.assumption[c], &stored = set.scattering[c];
    std::printf("left out %.1e, %.2e rms, %.2e of the peak\n", relative_error(left_out.rms, left_out.signal_rms),
                relative_error(stored.rms, stored.signal_rms), relative_error(stored.maximum, stored.peak));
    EXPECT_LT(relative_error(left_out.rms, left_out.signal_rms), 1e-8);
    EXPECT_LT(relative_error(stored.rms, stored.signal_rms), 0.0035);
    EXPECT_LT(relative_error(stored.maximum, stored.peak), 0.0025);
  }
}

}  // namespace
}  // namespace cuticle::lut::yan_fur::lut_yan_fur_test
