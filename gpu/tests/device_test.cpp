#include <numeric>

#include <gtest/gtest.h>

#include <scale_comp.spv.h>

#include <cuticle/gpu/device.h>

namespace cuticle::gpu {
namespace {

std::shared_ptr<Device> open_device() {
  auto device = Device::open({.choice = "cpu", .validation = true});
  EXPECT_TRUE(device.ok()) << (device ? "" : device.error().message);
  return *device;
}

std::vector<float> ramp(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 1.0f);
  return values;
}

struct ScaleConstants {
  float factor;
  std::uint32_t count;
};

Kernel scale_kernel(Device& device, std::uint32_t offset = 0) {
  auto kernel = device.make_kernel(scale_comp, {.storage_buffers = 2, .push_constant_bytes = sizeof(ScaleConstants),
                                                .specialization = {64, offset}});
  EXPECT_TRUE(kernel.ok());
  return std::move(*kernel);
}

TEST(GpuBuffer, Upload_ComesBackUnchanged) {
  const auto device = open_device();
  const std::vector<float> data = ramp(100000);
  auto buffer = make_buffer_from<float>(*device, data);
  ASSERT_TRUE(buffer.ok());
  EXPECT_EQ(*read_buffer<float>(*device, *buffer, data.size()), data);
}

TEST(GpuKernel, PushConstantsAndSpecialization_ReachTheShader) {
  const auto device = open_device();
  const std::vector<float> data = ramp(1000);
  auto source = make_buffer_from<float>(*device, data);
  auto target = device->make_buffer(data.size() * sizeof(float));
  const Kernel kernel = scale_kernel(*device, 7);
  Commands commands = device->record();
  const ScaleConstants constants{3, 1000};
  commands.dispatch(kernel, {&*source, &*target}, {}, bytes_of(constants), 16);
  const auto cost = device->submit(std::move(commands));
  ASSERT_TRUE(cost.ok()) << cost.error().message;
  const auto result = *read_buffer<float>(*device, *target, data.size());
  for (std::size_t i = 0; i < data.size(); ++i) EXPECT_EQ(result[i], data[i] * 3 + 7);
}

}  // namespace
}  // namespace cuticle::gpu
