#include "strands/lod/spread_order.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/random.h"

namespace cuticle::strands {

namespace {

constexpr std::size_t k_coordinates = 3 * std::tuple_size_v<StrandShape>;
using Coordinates = std::array<double, k_coordinates>;

double coordinate(const StrandShape& shape, std::size_t k) { return double(shape[k / 3][glm::length_t(k % 3)]); }

/// Puts strands in the order of the tree's leaves; which half of a part comes first is chance.
class Tree {
 public:
  explicit Tree(std::span<const StrandShape> shapes) : shapes_(shapes), leaves_(shapes.size()) {
    std::iota(leaves_.begin(), leaves_.end(), 0u);
    if (!leaves_.empty()) sort(leaves_);
  }
  const std::vector<std::uint32_t>& leaves() const { return leaves_; }

 private:
  using Part = std::span<std::uint32_t>;

  void sort(Part part) {
    if (part.size() < 2) return;
    const std::size_t half = part.size() / 2, widest = most_varied(part);
    const double way = chance_.next_unit() < 0.5 ? -1 : 1;
    std::ranges::nth_element(part, part.begin() + std::ptrdiff_t(half), {}, [&](std::uint32_t strand) {
      return std::pair(way * coordinate(shapes_[strand], widest), strand);
    });
    sort(part.first(half));
    sort(part.subspan(half));
  }

  std::size_t most_varied(Part part) const {
    Coordinates sums{}, squares{};
    for (std::uint32_t strand : part)
      for (std::size_t k = 0; k < k_coordinates; ++k) sums[k] += coordinate(shapes_[strand], k);
    for (std::uint32_t strand : part)
      for (std::size_t k = 0; k < k_coordinates; ++k) {
        const double away = coordinate(shapes_[strand], k) - sums[k] / double(part.size());
        squares[k] += away * away;
      }
    return std::size_t(std::ranges::max_element(squares) - squares.begin());
  }

  std::span<const StrandShape> shapes_;
  std::vector<std::uint32_t> leaves_;
  RandomStream chance_{20050401};
};

/// The bits of a number below 2^bits, last first.
std::size_t reversed(std::size_t number, int bits) {
  std::size_t result = 0;
  for (int bit = 0; bit < bits; ++bit) result |= (number >> bit & 1) << (bits - 1 - bit);
  return result;
}

}  // namespace

std::vector<StrandShape> shapes_of(const Groom& groom) {
  std::vector<StrandShape> shapes;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::span<const glm::vec3> strand = groom.strand(s);
    const std::size_t last = strand.size() - 1;
    shapes.push_back({strand[0], strand[last / 3], strand[2 * last / 3], strand[last]});
  }
  return shapes;
}

std::vector<std::uint32_t> spread_order(std::span<const StrandShape> shapes) {
  const Tree tree(shapes);
  const std::size_t count = shapes.size();
  const int bits = int(std::bit_width(count == 0 ? 0 : count - 1));
  std::vector<std::uint32_t> order;
  std::vector<bool> taken(count);
  for (std::size_t k = 0; order.size() < count; ++k) {
    const std::size_t leaf = reversed(k, bits) * count >> bits;
    if (!taken[leaf]) order.push_back(tree.leaves()[leaf]);
    taken[leaf] = true;
  }
  return order;
}

}  // namespace cuticle::strands
