// Opening devices, and their memory.
#include <numeric>

#include "gpu/tests/shared_device.h"

namespace cuticle::gpu::device_test {
namespace {

TEST(GpuDevice, List_NamesAtLeastOneUsableDevice) {
  const auto devices = list_devices();
  ASSERT_FALSE(devices.empty());
  EXPECT_TRUE(
      std::any_of(devices.begin(), devices.end(), [](const DeviceInfo& info) { return info.unusable.empty(); }));
}

TEST(GpuDevice, AbsurdName_IsNoDevice) {
  const auto device = Device::open({.choice = "no such card"});
  ASSERT_FALSE(device.ok());
  EXPECT_EQ(device.error().kind, ErrorKind::no_device);
  EXPECT_NE(device.error().message.find("no such card"), std::string::npos);
}

TEST(GpuDevice, Info_HasItsLimits) {
  const DeviceInfo& info = shared_device().info();
  EXPECT_GE(info.max_storage_buffer_bytes, std::uint64_t(1) << 27);
  EXPECT_GE(info.max_workgroup_invocations, 128u);
  EXPECT_GE(info.max_image_size, 4096u);
  ASSERT_FALSE(info.sample_counts.empty());
  EXPECT_EQ(info.sample_counts.front(), 1);
}

TEST(GpuDevice, TwoOfThem_WorkSideBySide) {
  const auto first = open_device(), second = open_device();
  const std::vector<float> data{1, 2, 3};
  const Buffer one = must(make_buffer_from<float>(*first, data)), two = must(make_buffer_from<float>(*second, data));
  EXPECT_EQ(must(read_buffer<float>(*first, one, 3)), data);
  EXPECT_EQ(must(read_buffer<float>(*second, two, 3)), data);
}

TEST(GpuDevice, BufferOfAnotherDevice_IsRefused) {
  const auto other = open_device();
  const Buffer foreign = must(other->make_buffer(64));
  Commands commands = shared_device().record();
  commands.fill(foreign, 0);
  const auto cost = shared_device().submit(std::move(commands));
  ASSERT_FALSE(cost.ok());
  EXPECT_NE(cost.error().message.find("another device"), std::string::npos);
}

TEST(GpuDevice, CommandsOfAnotherDevice_AreRefused) {
  const auto other = open_device();
  EXPECT_FALSE(shared_device().submit(other->record()).ok());
}

TEST(GpuDevice, Buffers_KeepItAlive) {
  Buffer buffer;
  {
    const auto device = open_device();
    buffer = must(device->make_buffer(64));
  }
  EXPECT_EQ(buffer.size(), 64u);
}

TEST(GpuMemory, Counts_ReturnToZeroAndThePeakStays) {
  const auto device = open_device();
  {
    const Buffer buffer = must(device->make_buffer(1 << 20));
    const Texture texture = must(device->make_texture({.size = {64, 64}}));
    EXPECT_GE(device->allocated_bytes(), (1u << 20) + 64 * 64 * 8);
  }
  EXPECT_EQ(device->allocated_bytes(), 0u);
  EXPECT_GE(device->peak_allocated_bytes(), (1u << 20) + 64 * 64 * 8);
}

TEST(GpuMemory, BufferPastTheLimit_IsRefusedNamingBoth) {
  Device& device = shared_device();
  const std::uint64_t limit = device.info().max_storage_buffer_bytes;
  const auto buffer = device.make_buffer(limit + 1);
  ASSERT_FALSE(buffer.ok());
  EXPECT_EQ(buffer.error().kind, ErrorKind::out_of_memory);
  EXPECT_NE(buffer.error().message.find(std::to_string(limit + 1)), std::string::npos);
  EXPECT_NE(buffer.error().message.find(std::to_string(limit)), std::string::npos);
}

TEST(GpuBuffer, Upload_ComesBackUnchanged) {
  std::vector<float> data(100000);
  std::iota(data.begin(), data.end(), 1.0f);
  const Buffer buffer = must(make_buffer_from<float>(shared_device(), data));
  EXPECT_EQ(must(read_buffer<float>(shared_device(), buffer, data.size())), data);
}

TEST(GpuBuffer, UploadAtAnOffset_LeavesTheRest) {
  Device& device = shared_device();
  const Buffer buffer = must(make_buffer_from<std::uint32_t>(device, std::vector<std::uint32_t>{1, 2, 3, 4}));
  const std::vector<std::uint32_t> part{8, 9};
  ASSERT_TRUE(device.upload(buffer, std::as_bytes(std::span(part)), 4).ok());
  EXPECT_EQ(must(read_buffer<std::uint32_t>(device, buffer, 4)), (std::vector<std::uint32_t>{1, 8, 9, 4}));
}

TEST(GpuBuffer, UploadPastItsEnd_IsRefused) {
  const Buffer buffer = must(shared_device().make_buffer(16));
  const std::vector<float> data(5);
  EXPECT_FALSE(shared_device().upload(buffer, std::as_bytes(std::span(data))).ok());
  EXPECT_FALSE(shared_device().upload(buffer, std::as_bytes(std::span(data).first(1)), 17).ok());
}

TEST(GpuBuffer, ZeroBytes_MakeASmallBuffer) { EXPECT_EQ(must(shared_device().make_buffer(0)).size(), 16u); }

TEST(GpuBuffer, FillAndCopy_MoveWords) {
  Device& device = shared_device();
  const Buffer from = must(device.make_buffer(16));
  const Buffer to = must(make_buffer_from<std::uint32_t>(device, std::vector<std::uint32_t>{1, 2, 3, 4}));
  Commands commands = device.record();
  commands.fill(from, 7);
  commands.copy(from, to, 8, 0, 4);
  must(device.submit(std::move(commands)));
  EXPECT_EQ(must(read_buffer<std::uint32_t>(device, to, 4)), (std::vector<std::uint32_t>{1, 7, 7, 4}));
}

TEST(GpuBuffer, Part_IsFilledCopiedAndReadWithinItsBuffer) {
  Device& device = shared_device();
  std::vector<std::uint32_t> words(192, 1);
  const Buffer all = must(make_buffer_from<std::uint32_t>(device, words)), copied = must(device.make_buffer(256));
  const Buffer part = part_of(all, 256, 256);
  ASSERT_EQ(part.size(), 256u);
  Commands commands = device.record();
  commands.fill(part, 7);
  commands.copy(part, copied, 256);
  must(device.submit(std::move(commands)));
  std::fill(words.begin() + 64, words.begin() + 128, 7u);
  words[65] = 9;
  ASSERT_TRUE(device.upload(part, std::as_bytes(std::span(words).subspan(65, 1)), 4).ok());
  EXPECT_EQ(must(read_buffer<std::uint32_t>(device, all, 192)), words);
  EXPECT_EQ(must(read_buffer<std::uint32_t>(device, part, 2)), (std::vector<std::uint32_t>{7, 9}));
  EXPECT_EQ(must(read_buffer<std::uint32_t>(device, copied, 64)), std::vector<std::uint32_t>(64, 7));
  EXPECT_FALSE(device.upload(part, std::as_bytes(std::span(words).first(65))).ok());
}

}  // namespace
}  // namespace cuticle::gpu::device_test
