#pragma once
// The Vulkan device of a test program.
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "gpu/device.h"

namespace cuticle::tests {

/// A new one, with validation. Where there is none no test of the program can run: it says why and fails.
inline std::shared_ptr<gpu::Device> open_device() {
  auto opened = gpu::Device::open({.choice = "", .validation = true});
  if (opened) return *opened;
  std::fprintf(stderr, "%s\n", opened.error().message.c_str());
  std::exit(EXIT_FAILURE);
}

/// The one that all tests of the program share.
inline const std::shared_ptr<gpu::Device>& device() {
  static const std::shared_ptr<gpu::Device> shared = open_device();
  return shared;
}

}  // namespace cuticle::tests
