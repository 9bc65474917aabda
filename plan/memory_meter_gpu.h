#pragma once
// Who holds how much device memory: by what allocations change while something is made or run.
#include <map>
#include <string>
#include <string_view>

#include "gpu/device.h"

namespace cuticle::plan {

class MemoryMeter {
 public:
  explicit MemoryMeter(const gpu::Device& device) : device_(device) {}
  /// Runs the work and counts what it allocated more than it gave back to `name`.
  template <class Work>
  auto count(std::string_view name, Work&& work) {
    const Counted counted{*this, name, device_.allocated_bytes()};
    return work();
  }
  /// Bytes by name; together what the device has allocated since the meter was made, if all work was counted.
  const std::map<std::string, std::size_t, std::less<>>& bytes() const { return bytes_; }

 private:
  struct Counted {
    MemoryMeter& meter;
    std::string_view name;
    std::size_t before;
    ~Counted() { meter.bytes_[std::string(name)] += meter.device_.allocated_bytes() - before; }
  };
  const gpu::Device& device_;
  std::map<std::string, std::size_t, std::less<>> bytes_;
};

}  // namespace cuticle::plan
