#include <algorithm>
#include <charconv>
#include <functional>

#include <fmt/format.h>

#include "gpu/detail/choice.h"

namespace cuticle::gpu {
namespace {

std::string found_text(const std::vector<DeviceInfo>& devices) {
  if (devices.empty()) return "no Vulkan device was found";
  std::string text = "found:";
  for (const DeviceInfo& device : devices) text += fmt::format(" [{}] {}", device.index, device.name);
  return text;
}

Error none_fits(const std::vector<DeviceInfo>& devices, std::string_view wanted) {
  return no_device_error(fmt::format("no {} ({})", wanted, found_text(devices)),
                         devices.empty() ? "install mesa-vulkan-drivers (software Vulkan), or a GPU driver"
                                         : "choose cpu, gpu, an index or a part of a name (CUTICLE_DEVICE)");
}

using Fits = std::function<bool(const DeviceInfo&)>;

const DeviceInfo* first(const std::vector<DeviceInfo>& devices, const Fits& fits) {
  for (const bool usable : {true, false})
    for (const DeviceInfo& device : devices)
      if (device.unusable.empty() == usable && fits(device)) return &device;
  return nullptr;
}

Result<int> first_or_error(const std::vector<DeviceInfo>& devices, const Fits& fits, std::string_view wanted) {
  const DeviceInfo* device = first(devices, fits);
  if (!device) return none_fits(devices, wanted);
  if (!device->unusable.empty())
    return no_device_error(fmt::format("{} cannot be used: {}", device->name, device->unusable),
                           "update its driver, or choose CUTICLE_DEVICE=cpu");
  return device->index;
}

bool is_number(const std::string& text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Result<int> choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice) {
  const Fits is_software = [](const DeviceInfo& device) { return device.is_software; };
  const Fits is_gpu = std::not_fn(is_software);
  if (choice == "cpu") return first_or_error(devices, is_software, "software Vulkan device");
  if (choice == "gpu") return first_or_error(devices, is_gpu, "GPU");
  if (choice.empty()) {
    const DeviceInfo* gpu = first(devices, is_gpu);
    return first_or_error(devices, gpu && gpu->unusable.empty() ? is_gpu : is_software, "Vulkan device");
  }
  int index = 0;
  if (is_number(choice, index))
    return first_or_error(
        devices, [&](const DeviceInfo& device) { return device.index == index; }, "device " + choice);
  return first_or_error(
      devices, [&](const DeviceInfo& device) { return device.name.find(choice) != std::string::npos; },
      fmt::format("device whose name contains \"{}\"", choice));
}

}  // namespace cuticle::gpu
