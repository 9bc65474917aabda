// Tables that follow their model's parameters on the device, against `bake` in double.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "lut/live_tables_gpu.h"

namespace cuticle::lut::lut_live_test {
namespace {

constexpr int k_size = 32;

const bsdf::Model& model(const char* name = "marschner") { return *bsdf::find_model(name).value(); }
registry::ParameterValues values(const std::string& text, const bsdf::Model& of = model()) {
  return bsdf::parse_settings(of, "", text).value();
}
const registry::ParameterValues& first_values() {
  static const registry::ParameterValues made = values("eta=1.55,sigma_a=0.1/0.2/0.4,beta_deg=6");
  return made;
}
const registry::ParameterValues& second_values() {
  static const registry::ParameterValues made = values("eta=1.45,sigma_a=0.8/0.3/0.05,beta_deg=9,alpha_deg=-3");
  return made;
}
using tests::device;

/// Tables of marschner in the layout nalu, of the first values; made once, because a kernel takes seconds to compile.
LiveTables& live_tables() {
  static LiveTables live =
      LiveTables::make(*device(), model(), first_values(), *find_layout("nalu").value(), k_size).value();
  EXPECT_TRUE(live.change(first_values()).ok());
  EXPECT_TRUE(live.finish().ok());
  return live;
}
std::vector<std::vector<float>> texels_of(const LiveTables& live) {
  std::vector<std::vector<float>> all;
  for (const gpu::Texture& texture : live.front()) all.push_back(device()->download(texture).value());
  return all;
}

struct Distance {
  double halves = 0;   ///< largest |texture - bake| / (2^-10 value + 1e-6)
  double of_peak = 0;  ///< largest |texture - bake| over the largest value of the table
};
Distance distance_from_bake(const LiveTables& live) {
  const TableSet cpu =
      bake(*live.set().model, live.set().values, *find_layout("nalu").value(), k_size, silent_progress()).value();
  const std::vector<std::vector<float>> texels = texels_of(live);
  Distance worst;
  for (std::size_t t = 0; t < cpu.tables.size(); ++t) {
    const std::vector<float>& expected = cpu.tables[t].image.pixels;
    const std::size_t channels = cpu.tables[t].scale.size();
    const double peak = double(*std::max_element(expected.begin(), expected.end()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double apart = std::abs(double(texels[t][4 * (i / channels) + i % channels]) - double(expected[i]));
      worst.halves = std::max(worst.halves, apart / (std::ldexp(double(expected[i]), -10) + 1e-6));
      worst.of_peak = std::max(worst.of_peak, apart / peak);
    }
  }
  return worst;
}

TEST(LiveTables, FirstTables_AreThoseOfBakeToHalfPrecision) {
  const LiveTables& live = live_tables();
  EXPECT_EQ(live.set().values, first_values());
  EXPECT_LT(distance_from_bake(live).halves, 1);
}

TEST(LiveTables, ChangedParameters_AreInTheTablesAfterTheSwap) {
  LiveTables& live = live_tables();
  ASSERT_TRUE(live.change(second_values()).ok());
  while (!live.update().value()) {
  }
  EXPECT_EQ(live.set().values, second_values());
  EXPECT_LT(distance_from_bake(live).halves, 1);
}

TEST(LiveTables, FrontTables_StayWhileABakeRuns) {
  LiveTables& live = live_tables();
  ASSERT_LT(distance_from_bake(live).halves, 1);
  const auto before = texels_of(live);
  const gpu::Texture* front = live.front().data();
  ASSERT_TRUE(live.change(second_values()).ok());
  EXPECT_TRUE(live.is_baking());
  EXPECT_EQ(live.front().data(), front);
  EXPECT_EQ(live.set().values, first_values());
  EXPECT_EQ(texels_of(live), before);  // the download runs after the bake has ended: it wrote elsewhere
  EXPECT_TRUE(live.update().value());
  EXPECT_NE(live.front().data(), front);
  EXPECT_NE(texels_of(live), before);
}

TEST(LiveTables, ManyChangesDuringABake_EndWithTheLatest) {
  LiveTables& live = live_tables();
  for (const char* text : {"eta=1.3", "eta=1.4", "eta=1.7"}) ASSERT_TRUE(live.change(values(text)).ok());
  ASSERT_TRUE(live.change(second_values()).ok());
  ASSERT_TRUE(live.finish().ok());
  EXPECT_FALSE(live.is_baking());
  EXPECT_EQ(live.set().values, second_values());
  EXPECT_LT(distance_from_bake(live).halves, 1);
}

TEST(LiveTables, NothingAsked_NothingIsSwapped) {
  LiveTables& live = live_tables();
  EXPECT_FALSE(live.update().value());
}

TEST(LiveTables, Cost_IsRecordedForEachBake) {
  LiveTables& live = live_tables();
  ASSERT_TRUE(live.change(second_values()).ok());
  ASSERT_TRUE(live.finish().ok());
  const RebakeCost& cost = live.last_cost();
  EXPECT_EQ(cost.dispatches, 1u);
  EXPECT_GT(cost.host_ms, 0);
  EXPECT_LE(cost.host_ms, cost.latency_ms);
  EXPECT_EQ(cost.device_ms > 0, device()->info().timestamps);
}

/// Where the model has no means of its own: a smooth N; and sharp peaks, which a quadrature in float meets only nearly.
TEST(LiveTables, MeansByQuadrature_AreNearThoseOfBake) {
  LiveTables& live = live_tables();
  const struct {
    const char* settings;
    double of_peak;
  } cases[] = {{"caustic=smoothed", 6e-4}, {"variant=as_published", 0.05}, {"aspect=0.9", 6e-4}};
  for (const auto& each : cases) {
    ASSERT_TRUE(live.change(values(each.settings)).ok());
    ASSERT_TRUE(live.finish().ok());
    const Distance distance = distance_from_bake(live);
    EXPECT_LT(distance.of_peak, each.of_peak) << each.settings << " " << distance.halves;
  }
}

TEST(LiveTables, SizeOutOfRange_IsRefused) {
  EXPECT_FALSE(LiveTables::make(*device(), model(), first_values(), *find_layout("nalu").value(), 8).ok());
}

}  // namespace
}  // namespace cuticle::lut::lut_live_test
