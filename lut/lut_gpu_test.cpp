// Tables baked on the device against tables baked on the CPU in double.
#include <cmath>

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

const TableSet& device_tables(const char* layout) {
  static std::map<std::string, TableSet> made;
  auto found = made.find(layout);
  if (found == made.end())
    found =
        made.emplace(layout, bake_gpu(*device(), marschner(), parameters(), *find_layout(layout).value(), 32).value())
            .first;
  return found->second;
}

/// A half holds 11 significant bits: neighbours differ by at most 2^-10 of the value.
TEST(BakeGpu, AnyLayout_AgreesWithTheCpuToHalfPrecision) {
  for (const char* name : {"nalu", "nalu2"}) {
    const Layout& layout = *find_layout(name).value();
    const TableSet cpu = bake(marschner(), parameters(), layout, 32, silent_progress()).value();
    const TableSet& gpu = device_tables(name);
    for (std::size_t t = 0; t < cpu.tables.size(); ++t)
      for (std::size_t i = 0; i < cpu.tables[t].image.pixels.size(); ++i) {
        const double expected = double(cpu.tables[t].image.pixels[i]), value = double(gpu.tables[t].image.pixels[i]);
        ASSERT_NEAR(value, expected, std::ldexp(expected, -10) + 1e-6)
            << name << " " << layout.tables[t].name << " value " << i << " singular "
            << int(cpu.tables[t].singular[i / cpu.tables[t].scale.size()]);
      }
  }
}

TEST(BakeGpu, BakedOn_IsTheDevicesName) { EXPECT_EQ(device_tables("nalu").baked_on, device()->info().name); }

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
