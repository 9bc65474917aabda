#pragma once
// Denormal results count as 0 while this lives. Always inlined: units of one instruction set leave no code.
#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace cuticle {

#ifdef __SSE__
/// Denormal numbers are slow, and worth nothing beside what they are added to.
class FlushToZero {
 public:
  [[gnu::always_inline]] FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }
  [[gnu::always_inline]] ~FlushToZero() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
};
#else
class FlushToZero {};
#endif

}  // namespace cuticle
