#pragma once
// Things that belong together because each is joined to another.
#include <cstdint>
#include <numeric>
#include <vector>

namespace cuticle::strands {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }
  /// One of the set, the same for all of it until it is joined to another.
  std::uint32_t find(std::uint32_t item) {
    while (parents_[item] != item) item = parents_[item] = parents_[parents_[item]];
    return item;
  }
  void join(std::uint32_t a, std::uint32_t b) { parents_[find(b)] = find(a); }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace cuticle::strands
