#pragma once
// Instruction sets for which units of batch code are compiled (cmake/CuticleBatch.cmake), and which the processor has.
#include <cstddef>
#include <string_view>

namespace cuticle {

/// In rising order: what every x86-64 (or any other) processor has; AVX2 with FMA (x86-64-v3); AVX-512 (x86-64-v4).
enum class InstructionSet { baseline, avx2, avx512 };
constexpr std::size_t instruction_set_count = 3;
/// "baseline", "avx2", "avx512".
std::string_view name_of(InstructionSet set);
/// Whether this processor has all that the compiler may use for it, and the environment variable CUTICLE_WIDEST_SET,
/// where it is set to a set's name, lets wider ones than that be taken.
bool processor_has(InstructionSet set);
/// Of the same compiled for each set, that of the widest one that this processor has.
template <class T>
const T& widest(const T& baseline, const T& avx2, const T& avx512) {
  if (processor_has(InstructionSet::avx512)) return avx512;
  return processor_has(InstructionSet::avx2) ? avx2 : baseline;
}

}  // namespace cuticle
