// Fitted texels keep their promises on small tables; lut_fit_gains_test measures what they gain.
#include <gtest/gtest.h>

#include "lut/fit/detail/texel_problem.h"
#include "lut/fit/texel_fit.h"

namespace cuticle::lut::lut_fit_test {
namespace {

TableSet baked(int size) {
  const bsdf::Model& model = *bsdf::find_model("marschner").value();
  const auto values = registry::parse_assignments(model.entry.parameters, "sigma_a=0.1/0.2/0.4").value();
  return bake(model, values, *find_layout("nalu").value(), size, silent_progress()).value();
}
TexelFit fitted(const TableSet& set, const Format& format) {
  return fit_texels(set, format, silent_progress()).value();
}

class FitTexels : public testing::TestWithParam<const char*> {
 protected:
  const Format& format = *find_format(GetParam()).value();
};
INSTANTIATE_TEST_SUITE_P(Formats, FitTexels, testing::Values("exr", "png8", "png16"));

TEST_P(FitTexels, EveryChannel_GainsAndKeepsTheMaximum) {
  const TexelFit fit = fitted(baked(24), format);
  EXPECT_TRUE(fit.set.fitted);
  ASSERT_EQ(fit.channels.size(), 11u);
  for (const ChannelFit& channel : fit.channels) {
    EXPECT_LE(channel.fitted.maximum, channel.unfitted.maximum) << channel.channel;
    EXPECT_LT(channel.fitted.rms, 0.85 * channel.unfitted.rms) << channel.channel;
  }
}

TEST_P(FitTexels, StoredNumbers_AreThoseOfTheFormat) {
  const TexelFit fit = fitted(baked(16), format);
  TableSet again = fit.set;
  ASSERT_TRUE(store_as(again, format).ok());
  for (std::size_t t = 0; t < again.tables.size(); ++t) {
    EXPECT_EQ(again.tables[t].image.pixels, fit.set.tables[t].image.pixels);
    for (float stored : again.tables[t].image.pixels) ASSERT_GE(stored, 0);
  }
}

TEST(KeepBelow, AnErrorPastTheBound_PutsSamplesBackAroundItOnly) {
  TexelProblem problem;
  problem.size = 3;
  problem.u = problem.v = {{0, 1}, {0.5, 0.5}};
  problem.exact.assign(4, 1.0);
  std::vector<double> samples(9, 1.0), texels = samples;
  texels[0] = 5;
  texels[8] = 1.2;
  EXPECT_TRUE(keep_below(problem, samples, 0.1, texels));
  EXPECT_EQ(texels[0], 1);
  EXPECT_EQ(texels[8], 1.2);
}

TEST(FitTexelsOfACaustic, MarkedTexels_KeepTheirAverages) {
  const TableSet before = baked(32);
  const Format& format = half_exr();
  TableSet samples = before;
  ASSERT_TRUE(store_as(samples, format).ok());
  const TexelFit fit = fitted(before, format);
  const Table &table = fit.set.tables[2], &sampled = samples.tables[2];
  int marked = 0, moved = 0;
  for (std::size_t i = 0; i < table.singular.size(); ++i) {
    ASSERT_TRUE(!table.singular[i] || table.image.pixels[3 * i] == sampled.image.pixels[3 * i]) << i;
    marked += table.singular[i];
    moved += table.image.pixels[3 * i] != sampled.image.pixels[3 * i];
  }
  EXPECT_GE(marked, 5);
  EXPECT_GT(moved, 400);
}

}  // namespace
}  // namespace cuticle::lut::lut_fit_test
