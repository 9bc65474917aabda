#pragma once
// Time by the clock.
#include <chrono>

namespace cuticle {

/// Milliseconds of wall clock since `start`.
inline double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace cuticle
