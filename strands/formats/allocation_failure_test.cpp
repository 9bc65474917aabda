// Memory that runs out anywhere in a reader: an error or std::bad_alloc, which the program turns into a message
// (docs/robustness.md), and everything that was taken is given back.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "strands/formats/format.h"

namespace {

std::atomic<long> allowed{-1};  ///< allocations until one fails; below 0: none does
std::atomic<long> live{0};

void* allocate(std::size_t size) {
  if (allowed.load() >= 0 && allowed.fetch_sub(1) == 0) throw std::bad_alloc();
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (!memory) throw std::bad_alloc();
  ++live;
  return memory;
}
void give_back(void* memory) {
  if (memory) --live;
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete[](void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give_back(memory); }

namespace cuticle::strands::allocation_failure_test {
namespace {

Groom sample() {
  Groom groom;
  for (int s = 0; s < 3; ++s) {
    for (int v = 0; v < 4; ++v) groom.positions.emplace_back(0.01f * float(s), 0.02f * float(v), 0.003f * float(v * v));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), 40e-6f);
  groom.root_uv = {{0, 0.5f}, {0.5f, 0.5f}, {1, 0.5f}};
  groom.attributes["heat"] = {Attribute::Domain::strand, 2, {1, 2, 3, 4, 5, 6}};
  return groom;
}

enum class Outcome { read, refused, no_memory };
Outcome outcome_of(const Format& format, std::span<const std::byte> bytes, long fails_at) {
  allowed = fails_at;
  Outcome outcome = Outcome::no_memory;
  try {
    outcome = format.parse(bytes, "sample", Damage::refuse) ? Outcome::read : Outcome::refused;
  } catch (const std::bad_alloc&) {
  }
  allowed = -1;
  return outcome;
}

TEST(AllocationFailure, AnywhereInAReader_IsReportedAndLosesNoMemory) {
  for (const Format* format : formats()) {
    if (!format->format || !format->parse) continue;
    Groom groom = sample();
    drop_what_it_cannot_hold(groom, *format);
    const std::vector<std::byte> bytes = format->format(groom, 1).value();
    ASSERT_EQ(outcome_of(*format, bytes, -1), Outcome::read) << format->name;  // and what is made once
    const long before = live;
    long failures = 0;
    for (; outcome_of(*format, bytes, failures) != Outcome::read; ++failures)
      ASSERT_LT(failures, 100000) << format->name;
    EXPECT_GT(failures, 3) << format->name;
    EXPECT_EQ(live, before) << format->name << ": memory is lost where an allocation fails";
    std::printf("%s: %ld allocations, each failed once\n", std::string(format->name).c_str(), failures);
  }
}

}  // namespace
}  // namespace cuticle::strands::allocation_failure_test
