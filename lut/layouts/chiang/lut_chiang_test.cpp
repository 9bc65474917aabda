// Tables of far fields whose N goes by the viewer's inclination, against the models themselves.
#include <gtest/gtest.h>

#include "lut/comparison.h"
#include "lut/format.h"

namespace cuticle::lut::chiang::lut_chiang_test {
namespace {

struct Fibre {
  const char *model, *settings;
};
struct Errors {
  double assumption, rms, maximum;
};
Errors errors_of(const Fibre& fibre) {
  const bsdf::Model& model = **bsdf::find_model(fibre.model);
  const auto values = bsdf::parse_settings(model, "", fibre.settings).value();
  TableSet set = *bake(model, values, **find_layout("chiang"), 128, silent_progress());
  EXPECT_TRUE(store_as(set, half_exr()).ok());
  EXPECT_TRUE(certify_scattering(cpu_source(model, values), set).ok());
  Errors worst{};
  for (std::size_t c = 0; c < 3; ++c) {
    const ChannelError &left_out = set.assumption[c], &stored = set.scattering[c];
    worst.assumption = std::max(worst.assumption, relative_error(left_out.rms, left_out.signal_rms));
    worst.rms = std::max(worst.rms, relative_error(stored.rms, stored.signal_rms));
    worst.maximum = std::max(worst.maximum, relative_error(stored.maximum, stored.peak));
  }
  return worst;
}

/// Measured: nothing left out, .13 % rms, .16 % of the peak; `factored` has 7.8 % rms.
TEST(LayoutChiang, FarFieldOfChiang_IsWithinItsMeasuredError) {
  const Errors errors = errors_of({"chiang", "field=far"});
  EXPECT_LT(errors.assumption, 1e-8);
  EXPECT_LT(errors.rms, 0.0016);
  EXPECT_LT(errors.maximum, 0.002);
}
/// Measured: .27 % rms, .26 % of the peak.
TEST(LayoutChiang, DeonByTheViewersInclination_IsWithinItsMeasuredError) {
  const Errors errors = errors_of({"deon", "azimuthal_tolerance=1e-3"});
  EXPECT_LT(errors.assumption, 1e-8);
  EXPECT_LT(errors.rms, 0.0035);
  EXPECT_LT(errors.maximum, 0.0035);
}

}  // namespace
}  // namespace cuticle::lut::chiang::lut_chiang_test
