// A device that fails in the middle of work: the error says what happened, and nothing is left behind. The driver's
// entries are taken the place of, since software Vulkan does neither by itself.
#include <gmock/gmock.h>

#include "gpu/detail/device_impl.h"
#include "gpu/tests/shared_device.h"

namespace cuticle::gpu::gpu_faults_test {
namespace {

using testing::HasSubstr;

VKAPI_ATTR VkResult VKAPI_CALL lost(VkQueue, std::uint32_t, const VkSubmitInfo2*, VkFence) {
  return VK_ERROR_DEVICE_LOST;
}
VKAPI_ATTR VkResult VKAPI_CALL full(VkDevice, const VkMemoryAllocateInfo*, const VkAllocationCallbacks*,
                                    VkDeviceMemory*) {
  return VK_ERROR_OUT_OF_DEVICE_MEMORY;
}

/// In place of an entry of the driver as long as it lives.
template <class Entry>
class InPlaceOf {
 public:
  InPlaceOf(Entry& entry, Entry other) : entry_(entry), own_(std::exchange(entry, other)) {}
  ~InPlaceOf() { entry_ = own_; }
  InPlaceOf(const InPlaceOf&) = delete;
  InPlaceOf& operator=(const InPlaceOf&) = delete;

 private:
  Entry& entry_;
  Entry own_;
};

TEST(GpuFaults, DeviceLostBeforeASubmission_IsAnErrorThatSaysWhatToDo) {
  const auto device = open_device();
  const Buffer buffer = must(device->make_buffer(64));
  Commands commands = device->record();
  commands.fill(buffer, 7);
  {
    const InPlaceOf fault(device->impl()->vk.vkQueueSubmit2, PFN_vkQueueSubmit2(lost));
    const auto cost = device->submit(std::move(commands));
    ASSERT_FALSE(cost);
    EXPECT_EQ(cost.error().kind, ErrorKind::no_device);
    EXPECT_THAT(cost.error().message, HasSubstr("the device was lost"));
    EXPECT_THAT(cost.error().hint, HasSubstr("CUTICLE_DEVICE=cpu"));
  }
  Commands again = device->record();
  again.fill(buffer, 7);
  EXPECT_TRUE(device->submit(std::move(again))) << "recorded work can be submitted where the device is there again";
}

TEST(GpuFaults, DeviceWithoutMemory_IsAnErrorWithTheSizesAndCountsNothing) {
  const auto device = open_device();
  const std::size_t before = device->allocated_bytes();
  {
    const InPlaceOf fault(device->impl()->vk.vkAllocateMemory, PFN_vkAllocateMemory(full));
    const auto buffer = device->make_buffer(1 << 20);
    ASSERT_FALSE(buffer);
    EXPECT_EQ(buffer.error().kind, ErrorKind::out_of_memory);
    EXPECT_THAT(buffer.error().message, HasSubstr("1048576 bytes do not fit on"));
    EXPECT_THAT(buffer.error().hint, HasSubstr("fewer strands"));
    EXPECT_FALSE(device->make_texture({.size = glm::ivec2(64)}));
  }
  EXPECT_EQ(device->allocated_bytes(), before);
  EXPECT_TRUE(device->make_buffer(1 << 20));
}

}  // namespace
}  // namespace cuticle::gpu::gpu_faults_test
