#pragma once
// For tests: one software device with validation, shared by the tests of a file.
#include <stdexcept>

#include <gtest/gtest.h>

#include "gpu/device.h"

namespace cuticle::gpu {

inline std::shared_ptr<Device> open_device() {
  auto device = Device::open({.choice = "", .validation = true});
  if (!device) ADD_FAILURE() << device.error().message;
  return device ? *device : nullptr;
}

inline Device& shared_device() {
  static const std::shared_ptr<Device> device = open_device();
  return *device;
}

/// The value; an error ends the test with its text.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

}  // namespace cuticle::gpu
