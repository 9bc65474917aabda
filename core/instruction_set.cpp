#include "core/instruction_set.h"

#include <array>
#include <cstdlib>

namespace cuticle {
namespace {

constexpr std::array<std::string_view, instruction_set_count> set_names = {"baseline", "avx2", "avx512"};

#if defined(__x86_64__)
// What -march=x86-64-v3 and -v4 may use beside the vectors themselves came with them; clang 14 does not know the
// levels' names.
bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
}
bool has_avx512() {
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

/// Sets wider than the one that CUTICLE_WIDEST_SET names are not taken, so that each can be tested and timed.
bool is_allowed(InstructionSet set) {
  static const char* const widest = std::getenv("CUTICLE_WIDEST_SET");
  if (widest == nullptr) return true;
  for (std::size_t k = std::size_t(set); k < set_names.size(); ++k)
    if (set_names[k] == widest) return true;
  return false;
}

}  // namespace

std::string_view name_of(InstructionSet set) { return set_names[std::size_t(set)]; }

bool processor_has(InstructionSet set) {
#if defined(__x86_64__)
  if (!is_allowed(set)) return set == InstructionSet::baseline;
  if (set == InstructionSet::avx2) return has_avx2();
  if (set == InstructionSet::avx512) return has_avx512();
#endif
  return set == InstructionSet::baseline;
}

}  // namespace cuticle
