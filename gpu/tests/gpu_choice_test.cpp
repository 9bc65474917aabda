// Which device a request means, and the conversions of texels: no device needed.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gpu/detail/choice.h"
#include "gpu/detail/texels.h"

namespace cuticle::gpu::gpu_choice_test {
namespace {

DeviceInfo named(int index, std::string name, bool is_software, std::string unusable = {}) {
  DeviceInfo info;
  info.index = index;
  info.name = std::move(name);
  info.is_software = is_software;
  info.unusable = std::move(unusable);
  return info;
}

std::vector<DeviceInfo> workstation() {
  return {named(0, "llvmpipe (LLVM)", true), named(1, "Old card", false, "its Vulkan is older than 1.3"),
          named(2, "New card", false)};
}

TEST(GpuChoice, Nothing_TakesTheFirstUsableGpu) { EXPECT_EQ(*choose_device(workstation(), ""), 2); }
TEST(GpuChoice, NothingWithoutAGpu_TakesSoftware) { EXPECT_EQ(*choose_device({named(0, "llvmpipe", true)}, ""), 0); }
TEST(GpuChoice, NothingWithAnUnusableGpuOnly_TakesSoftware) {
  EXPECT_EQ(*choose_device({named(0, "Old card", false, "old"), named(1, "llvmpipe", true)}, ""), 1);
}
TEST(GpuChoice, Cpu_TakesSoftware) { EXPECT_EQ(*choose_device(workstation(), "cpu"), 0); }
TEST(GpuChoice, Gpu_TakesAUsableGpu) { EXPECT_EQ(*choose_device(workstation(), "gpu"), 2); }
TEST(GpuChoice, Index_TakesThatDevice) { EXPECT_EQ(*choose_device(workstation(), "2"), 2); }
TEST(GpuChoice, PartOfAName_TakesTheFirstThatContainsIt) { EXPECT_EQ(*choose_device(workstation(), "New"), 2); }

TEST(GpuChoice, IndexOfAnUnusableDevice_SaysWhy) {
  const auto chosen = choose_device(workstation(), "1");
  ASSERT_FALSE(chosen.ok());
  EXPECT_NE(chosen.error().message.find("older than 1.3"), std::string::npos);
}

TEST(GpuChoice, GpuWhereThereIsNone_IsNoDeviceAndListsWhatThereIs) {
  const auto chosen = choose_device({named(0, "llvmpipe", true)}, "gpu");
  ASSERT_FALSE(chosen.ok());
  EXPECT_EQ(chosen.error().kind, ErrorKind::no_device);
  EXPECT_NE(chosen.error().message.find("[0] llvmpipe"), std::string::npos);
}

TEST(GpuChoice, NoDevices_SaysWhatToInstall) {
  const auto chosen = choose_device({}, "");
  ASSERT_FALSE(chosen.ok());
  EXPECT_EQ(chosen.error().kind, ErrorKind::no_device);
  EXPECT_NE(chosen.error().hint.find("mesa-vulkan-drivers"), std::string::npos);
}

TEST(GpuHalf, EveryHalf_ComesBackUnchanged) {
  for (std::uint32_t bits = 0; bits < 0x10000u; ++bits) {
    const float value = float_from_half(std::uint16_t(bits));
    if (std::isnan(value)) continue;
    ASSERT_EQ(half_from_float(value), bits) << value;
  }
}

TEST(GpuHalf, FloatsBetweenHalves_RoundToTheNearerAndTiesToEven) {
  for (std::uint32_t bits = 0; bits < 0x7bffu; ++bits) {
    const float lower = float_from_half(std::uint16_t(bits)), upper = float_from_half(std::uint16_t(bits + 1));
    const float middle = (lower + upper) / 2;
    ASSERT_EQ(half_from_float(middle), bits + (bits & 1u)) << lower;
    ASSERT_EQ(half_from_float(std::nextafter(middle, lower)), bits) << lower;
    ASSERT_EQ(half_from_float(std::nextafter(middle, upper)), bits + 1) << lower;
  }
}

TEST(GpuHalf, PastTheLargest_IsInfinityAndNanStaysNan) {
  EXPECT_EQ(half_from_float(65519.0f), 0x7bff);
  EXPECT_EQ(half_from_float(65520.0f), 0x7c00);
  EXPECT_EQ(half_from_float(-1e30f), 0xfc00);
  EXPECT_TRUE(std::isnan(float_from_half(half_from_float(std::numeric_limits<float>::quiet_NaN()))));
}

TEST(GpuChunks, ALimit_IsPassedByNoPartAndEveryItemIsInOne) {
  const std::vector<Chunk> parts = chunks(10, 12, 40);
  ASSERT_EQ(parts.size(), 4u);
  std::size_t next = 0;
  for (const Chunk& part : parts) {
    EXPECT_EQ(part.begin, next);
    EXPECT_LE((part.end - part.begin) * 12, 40u);
    next = part.end;
  }
  EXPECT_EQ(next, 10u);
}

TEST(GpuChunks, NoItems_AreNoParts) { EXPECT_TRUE(chunks(0, 4, 100).empty()); }
TEST(GpuChunks, ItemsLargerThanTheLimit_StandAlone) { EXPECT_EQ(chunks(3, 200, 100).size(), 3u); }

}  // namespace
}  // namespace cuticle::gpu::gpu_choice_test
