#pragma once
// Room for large arrays.
#include <cstdint>
#include <vector>

#include <sys/mman.h>

namespace cuticle::strands {

/// Reserves room and asks for huge pages: touching 4 KiB pages for the first time costs more than filling them.
template <class T>
void reserve_large(std::vector<T>& items, std::size_t count) {
  constexpr std::uintptr_t page = 4096, worth_it = 8u << 20;
  items.reserve(count);
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(items.data()) + page - 1) / page * page;
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(items.data()) + count * sizeof(T);
  if (count * sizeof(T) >= worth_it) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace cuticle::strands
