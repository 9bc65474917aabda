#pragma once
// Where the program meets the system: whatever goes wrong inside ends in a message and an exit code.
#include <cstdint>
#include <functional>

#include "core/result.h"

namespace cuticle::cli {

/// Runs the program's work and gives its exit code. An exception becomes a message and the code 3, 4 or 5; so does
/// standard output that is closed or full, if all else went well. An interrupt (SIGINT, SIGTERM, SIGHUP) removes what
/// is half written and gives 128 + its number; work that can stop between two steps is asked to do so first.
int guarded(const std::function<int()>& work);

/// The most bytes that the program and what it reads may take (--max-memory).
Result<void> limit_memory(std::uint64_t bytes);

/// For a child process between fork and exec: signals as they were at the start.
void restore_signals();

}  // namespace cuticle::cli
