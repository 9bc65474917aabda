#pragma once
// For tests: one software device with validation, shared by the tests of a file.
#include <stdexcept>

#include "gpu/tests/test_device.h"

namespace cuticle::gpu {

using tests::open_device;

inline Device& shared_device() { return *tests::device(); }

/// The value; an error ends the test with its text.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

}  // namespace cuticle::gpu
