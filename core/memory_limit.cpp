#include "core/memory_limit.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <fstream>
#include <limits>

#include <unistd.h>

#include <fmt/core.h>

namespace cuticle {
namespace {

constexpr std::uint64_t k_mebibyte = std::uint64_t(1) << 20, k_least = 64 * k_mebibyte;
constexpr std::uint64_t k_greatest = std::numeric_limits<std::uint64_t>::max();

std::uint64_t memory_of_machine() {
  std::uint64_t most = std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGESIZE));
  std::uint64_t group = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> group && group > 0) most = std::min(most, group);
  return most;
}

std::atomic<std::uint64_t>& limit() {
  static std::atomic<std::uint64_t> bytes{std::max(memory_of_machine() / 2, k_least)};
  return bytes;
}

}  // namespace

std::optional<std::uint64_t> product_within(std::uint64_t most, std::span<const std::uint64_t> factors) {
  std::uint64_t product = 1;
  for (const std::uint64_t factor : factors) {
    if (factor > 0 && product > most / factor) return {};
    product *= factor;
  }
  return product <= most ? std::optional(product) : std::nullopt;
}

std::uint64_t memory_limit() { return limit(); }
void set_memory_limit(std::uint64_t bytes) { limit() = bytes; }

Result<std::uint64_t> parse_memory(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, number);
  const std::string_view unit(rest, std::size_t(end - rest));
  const int shift = unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : unit == "T" ? 40 : 0;
  const auto bytes = product_within(k_greatest, {number, std::uint64_t(1) << shift});
  if (code == std::errc() && (unit.empty() || shift > 0) && bytes && *bytes >= k_least) return *bytes;
  return usage_error(fmt::format("--max-memory: '{}' is no size of at least 64M", text.substr(0, 40)),
                     "--max-memory 8G");
}

Result<void> require_memory(std::string_view what, std::initializer_list<std::uint64_t> factors) {
  if (product_within(memory_limit(), factors)) return {};
  const auto bytes = product_within(k_greatest, factors);
  return bad_input(
      fmt::format("{} needs {} MiB, allowed {} MiB", what,
                  bytes ? std::to_string(*bytes / k_mebibyte) : "more than 2^44", memory_limit() / k_mebibyte),
      "raise --max-memory if the file is what you think it is");
}

}  // namespace cuticle
