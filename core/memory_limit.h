#pragma once
// How much memory what is read may take: sizes that files state are checked before anything is allocated for them.
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace cuticle {

/// The product, where it is at most `most`; of no factors it is 1.
std::optional<std::uint64_t> product_within(std::uint64_t most, std::span<const std::uint64_t> factors);
inline std::optional<std::uint64_t> product_within(std::uint64_t most, std::initializer_list<std::uint64_t> factors) {
  return product_within(most, std::span(factors.begin(), factors.size()));
}

/// The most bytes that one thing read may take: half of the memory of the machine or of its control group, unless set.
std::uint64_t memory_limit();
void set_memory_limit(std::uint64_t bytes);
/// "512M", "8G" or bytes. Error: usage, below 64M or no number.
Result<std::uint64_t> parse_memory(const std::string& text);

/// Error: bad_input "WHAT needs N MiB, allowed M MiB" where the product of the factors, in bytes, is above the limit.
Result<void> require_memory(std::string_view what, std::initializer_list<std::uint64_t> factors);

}  // namespace cuticle
