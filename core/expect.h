#pragma once
// CUTICLE_EXPECT(condition, text): a promise between our own functions. On in debug and sanitizer builds, free otherwise.
#include <cstdio>
#include <cstdlib>

#if !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__)
#define CUTICLE_EXPECT(condition, text)                                                              \
  do {                                                                                               \
    if (!(condition)) {                                                                              \
      std::fprintf(stderr, "%s:%d: broken promise: %s (%s)\n", __FILE__, __LINE__, text, #condition); \
      std::abort();                                                                                  \
    }                                                                                                \
  } while (false)
#else
#define CUTICLE_EXPECT(condition, text) \
  do {                                  \
  } while (false)
#endif
