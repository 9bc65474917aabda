// Tables baked on the device against tables baked on the CPU in double.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "lut/bake_gpu.h"
#include "lut/format.h"

namespace cuticle::lut::lut_gpu_test {
namespace {

const bsdf::Model& marschner() { return *bsdf::find_model("marschner").value(); }
registry::ParameterValues parameters() {
  return registry::parse_assignments(marschner().entry.parameters, "eta=1.55,sigma_a=0.1/0.2/0.4,beta_deg=6").value();
}
using tests::device;

/// Tables of 32; made once a layout, because a kernel takes seconds to compile.
DeviceBaker& baker(const std::string& layout) {
  static std::map<std::string, DeviceBaker> made;
  return made.try_emplace(layout, *device(), marschner(), *find_layout(layout).value(), 32).first->second;
}

struct Distance {
  double halves = 0;   ///< largest |device - bake| / (2^-10 value + 1e-6)
  double of_peak = 0;  ///< largest |device - bake| over the largest value of the table
};
Distance distance_from_bake(const TableSet& gpu) {
  const TableSet cpu = bake(marschner(), gpu.values, *gpu.layout, gpu.size, silent_progress()).value();
  Distance worst;
  for (std::size_t t = 0; t < cpu.tables.size(); ++t) {
    const std::vector<float>&expected = cpu.tables[t].image.pixels, &found = gpu.tables[t].image.pixels;
    const double peak = double(*std::max_element(expected.begin(), expected.end()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double apart = std::abs(double(found[i]) - double(expected[i]));
      worst.halves = std::max(worst.halves, apart / (std::ldexp(double(expected[i]), -10) + 1e-6));
      worst.of_peak = std::max(worst.of_peak, apart / peak);
    }
  }
  return worst;
}

/// A half holds 11 significant bits: neighbours differ by at most 2^-10 of the value.
TEST(BakeGpu, AnyLayout_AgreesWithTheCpuToHalfPrecision) {
  for (const char* name : {"nalu", "nalu2"})
    EXPECT_LT(distance_from_bake(baker(name).bake(parameters()).value()).halves, 1) << name;
}

TEST(BakeGpu, ChangedParameters_AreThoseOfTheNextTables) {
  const auto changed =
      bsdf::parse_settings(marschner(), "", "eta=1.45,sigma_a=0.8/0.3/0.05,beta_deg=9,alpha_deg=-3").value();
  const TableSet first = baker("nalu").bake(parameters()).value(), second = baker("nalu").bake(changed).value();
  EXPECT_EQ(second.values, changed);
  EXPECT_LT(distance_from_bake(second).halves, 1);
  EXPECT_EQ(baker("nalu").last_cost().passes.at(0).dispatches, 1u);
  EXPECT_EQ(baker("nalu").bake(parameters()).value().tables[1].image.pixels, first.tables[1].image.pixels);
}

/// Where the model has no means of its own: a smooth N; and sharp peaks, which a quadrature in float meets only nearly.
TEST(BakeGpu, MeansByQuadrature_AreNearThoseOfBake) {
  const struct {
    const char* settings;
    double of_peak;
  } cases[] = {{"caustic=smoothed", 6e-4}, {"variant=as_published", 0.05}, {"aspect=0.9", 6e-4}};
  for (const auto& each : cases) {
    const auto values = bsdf::parse_settings(marschner(), "", each.settings).value();
    const Distance distance = distance_from_bake(baker("nalu").bake(values).value());
    EXPECT_LT(distance.of_peak, each.of_peak) << each.settings << " " << distance.halves;
  }
}

TEST(BakeGpu, BakedOn_IsTheDevicesName) {
  EXPECT_EQ(baker("nalu").bake(parameters()).value().baked_on, device()->info().name);
}

TEST(BakeGpu, SizeOutOfRange_IsRefused) {
  EXPECT_FALSE(bake_gpu(*device(), marschner(), parameters(), *find_layout("nalu").value(), 8).ok());
}

TEST(Upload, Textures_HoldTheValuesInHalfWithMissingChannelsZero) {
  TableSet set = bake(marschner(), parameters(), *find_layout("nalu").value(), 16, silent_progress()).value();
  ASSERT_TRUE(store_as(set, *find_format("png16").value()).ok());
  const std::vector<gpu::Texture> textures = upload(*device(), set).value();
  ASSERT_EQ(textures.size(), 3u);
  const std::vector<float> texels = device()->download(textures[2]).value();
  ASSERT_EQ(texels.size(), 16u * 16 * 4);
  for (std::size_t i = 0; i < 256; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = double(set.tables[2].image.pixels[i * 3 + c]) * set.tables[2].scale[c];
      ASSERT_NEAR(double(texels[i * 4 + c]), value, std::ldexp(value, -10) + 1e-7);
    }
    ASSERT_EQ(texels[i * 4 + 3], 0.0F);
  }
}

}  // namespace
}  // namespace cuticle::lut::lut_gpu_test
