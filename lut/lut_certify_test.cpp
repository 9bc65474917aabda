// Stored formats, the engine's filter, and errors that are measured and not asserted.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lut/format.h"
#include "lut/table_set.h"

namespace cuticle::lut::lut_certify_test {
namespace {

const bsdf::Model& marschner() { return *bsdf::find_model("marschner").value(); }
TableSet bake_set(const char* settings, int size) {
  const auto values = registry::parse_assignments(marschner().entry.parameters, settings).value();
  return bake(marschner(), values, *find_layout("nalu").value(), size, silent_progress()).value();
}
TableSet certified(const char* settings, int size, const Format& format) {
  TableSet set = bake_set(settings, size);
  EXPECT_TRUE(certify(set, format, silent_progress()).ok());
  return set;
}
double relative_rms(const ChannelError& error) { return error.rms / error.signal_rms; }

TEST(StoreAs, EightBit_HoldsTheUnitRangeAndAScaleThatGivesTheValuesBack) {
  const TableSet before = bake_set("sigma_a=0.2", 32);
  TableSet set = before;
  ASSERT_TRUE(store_as(set, *find_format("png8").value()).ok());
  for (std::size_t t = 0; t < set.tables.size(); ++t) {
    const Table& table = set.tables[t];
    for (std::size_t i = 0; i < table.image.pixels.size(); ++i) {
      const double stored = table.image.pixels[i], scale = table.scale[i % table.scale.size()];
      ASSERT_TRUE(stored >= 0 && stored <= 1);
      ASSERT_NEAR(stored * 255, std::round(stored * 255), 1e-4);
      ASSERT_NEAR(stored * scale, before.tables[t].image.pixels[i], scale * 0.5001 / 255);
    }
  }
}

TEST(StoreAs, Half_RoundsToHalf) {
  TableSet set = bake_set("sigma_a=0.2", 32);
  ASSERT_TRUE(store_as(set, half_exr()).ok());
  for (float value : set.tables[0].image.pixels) ASSERT_EQ(value, round_to_half(value));
  EXPECT_THAT(set.tables[0].scale, testing::Each(1.0));
}

TEST(StoreAs, ValuesBeyondHalf_AreScaledDown) {
  TableSet set = bake_set("sigma_a=0.2", 16);
  set.tables[0].image.at(3, 3, 0) = 1e6F;
  ASSERT_TRUE(store_as(set, half_exr()).ok());
  EXPECT_NEAR(double(set.tables[0].image.at(3, 3, 0)) * set.tables[0].scale[0], 1e6, 1e3);
}

TEST(StoreAs, NegativeOrNotFinite_IsAnErrorThatNamesTheChannel) {
  for (float bad : {-1.0F, std::nanf(""), INFINITY}) {
    TableSet set = bake_set("sigma_a=0.2", 16);
    set.tables[0].image.at(3, 3, 1) = bad;
    const auto result = store_as(set, half_exr());
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, testing::HasSubstr("M_TT"));
  }
}

TEST(Sample, TexelCentresMiddlesAndBeyondTheEdge_AreBilinearAndClamped) {
  Table table;
  table.image = make_image(2, 2, {"R"});
  table.image.pixels = {1, 3, 5, 11};
  table.scale = {2};
  EXPECT_DOUBLE_EQ(sample(table, 0, 0.25, 0.25), 2);
  EXPECT_DOUBLE_EQ(sample(table, 0, 0.5, 0.25), 4);
  EXPECT_DOUBLE_EQ(sample(table, 0, 0.5, 0.5), 10);
  EXPECT_DOUBLE_EQ(sample(table, 0, 0.0, 1.0), 10);
  EXPECT_DOUBLE_EQ(sample(table, 0, -3.0, 9.0), 10);
}

TEST(Certify, PerturbedTexel_RaisesTheMeasuredErrorToThePerturbation) {
  TableSet set = bake_set("sigma_a=0.2", 64);
  TableSet broken = set;
  broken.tables[1].image.at(30, 30, 0) += 0.25F;
  ASSERT_TRUE(certify(set, half_exr(), silent_progress()).ok());
  ASSERT_TRUE(certify(broken, half_exr(), silent_progress()).ok());
  EXPECT_LT(set.tables[1].errors[0].maximum, 0.05);
  EXPECT_NEAR(broken.tables[1].errors[0].maximum, 0.25, 0.07);
  EXPECT_EQ(broken.tables[1].errors[3].maximum, set.tables[1].errors[3].maximum);
}

TEST(Certify, PerturbedCellAverage_RaisesTheMeasuredError) {
  TableSet set = bake_set("sigma_a=0.2", 64);
  TableSet broken = set;
  broken.tables[2].image.at(10, 30, 1) += 0.5F;
  ASSERT_TRUE(certify(set, half_exr(), silent_progress()).ok());
  ASSERT_TRUE(certify(broken, half_exr(), silent_progress()).ok());
  EXPECT_GT(broken.tables[2].errors[1].rms, 1.02 * set.tables[2].errors[1].rms);
}

TEST(Certify, FlippedTable_ShowsAnErrorOfTheSignalsOrder) {
  TableSet set = bake_set("sigma_a=0.2", 64);
  Table& m = set.tables[0];
  Image flipped = m.image;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 4; ++c) flipped.at(x, y, c) = m.image.at(x, 63 - y, c);
  m.image = flipped;
  ASSERT_TRUE(certify(set, half_exr(), silent_progress()).ok());
  EXPECT_GT(relative_rms(m.errors[0]), 0.8);
}

TEST(Certify, EightBit_IsWorseThanHalf) {
  const TableSet half = certified("sigma_a=0.2", 64, half_exr()),
                 eight = certified("sigma_a=0.2", 64, *find_format("png8").value());
  for (int c : {0, 1, 2}) EXPECT_GT(eight.tables[1].errors[c].rms, 2 * half.tables[1].errors[c].rms);
}

TEST(Certify, MoreTexels_LessError) {
  const TableSet coarse = certified("sigma_a=0.2", 32, half_exr()), fine = certified("sigma_a=0.2", 64, half_exr());
  EXPECT_LT(fine.tables[0].errors[0].rms, 0.5 * coarse.tables[0].errors[0].rms);
  EXPECT_LT(fine.tables[1].errors[1].rms, 0.5 * coarse.tables[1].errors[1].rms);
  EXPECT_LT(fine.tables[2].errors[1].rms, coarse.tables[2].errors[1].rms);
}

/// rms error over rms signal of a channel of M where both inclinations stay within 80 degrees.
double error_within_80_degrees(const Table& table, const TableSet& set, int c) {
  const double limit = std::sin(80 * std::acos(-1.0) / 180);
  double error = 0, signal = 0;
  for (int y = 0; y < 211; ++y)
    for (int x = 0; x < 211; ++x) {
      const double u = (1 + limit * (2 * (x + 0.5) / 211 - 1)) / 2, v = (1 + limit * (2 * (y + 0.5) / 211 - 1)) / 2;
      const double exact = exact_value(*set.model, set.values, *table.layout, table.layout->channels[c], u, v);
      const auto coordinate = [](double fraction) { return (fraction * 127 + 0.5) / 128; };
      const double difference = sample(table, c, coordinate(u), coordinate(v)) - exact;
      error += difference * difference;
      signal += exact * exact;
    }
  return std::sqrt(error / signal);
}

/// Bilinear tables of 128^2 over the sines, lobes of 5, 2.5 and 10 degrees in theta_h: earlier measurements with
/// Gaussian lobes gave 1.2e-2, 2.3e-2 and 7.6e-3 over all angles, most of it at grazing ones; within 80 degrees ours
/// stay below.
TEST(Certify, LongitudinalErrorsAt128_AreOfTheKnownOrder) {
  TableSet set = bake_set("beta=0.174533,alpha=0", 128);
  ASSERT_TRUE(store_as(set, half_exr()).ok());
  const double known[] = {1.2e-2, 2.3e-2, 7.6e-3};
  for (int c = 0; c < 3; ++c) {
    const double error = error_within_80_degrees(set.tables[0], set, c);
    EXPECT_LT(error, known[c]) << c;
    EXPECT_GT(error, known[c] / 20) << c;
  }
}

TEST(Certify, CausticLobeAt128_IsWithinItsMeasuredBounds) {
  const TableSet set = certified("sigma_a=0.2", 128, half_exr());
  const ChannelError& error = set.tables[2].errors[1];
  EXPECT_LT(relative_rms(error), 0.05);
  EXPECT_LT(error.maximum, 0.25 * error.peak);
  EXPECT_LT(error.percentile_99, 0.003 * error.peak);
  EXPECT_LT(error.excluded, 0.03);
  EXPECT_GT(error.excluded, 0.005);
}

}  // namespace
}  // namespace cuticle::lut::lut_certify_test
