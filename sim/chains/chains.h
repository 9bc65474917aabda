#pragma once
// Strands as chains of links below their anchors, in blocks of 16 that have equally many links: the arrays of the CPU's
// units and of the kernel (rows of exact/kernel.h).
#include <cstdint>
#include <new>
#include <vector>

#include "sim/chains/chain_settings.h"
#include "strands/groom.h"

#include "sim/chains/chain_rows.h"

namespace cuticle::sim::chains {

/// Begins where a register may be loaded without crossing a cache line.
template <class T>
struct RowAllocator {
  using value_type = T;
  static constexpr std::align_val_t k_line{64};
  RowAllocator() = default;
  template <class U>
  RowAllocator(const RowAllocator<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), k_line)); }
  void deallocate(T* rows, std::size_t) { ::operator delete(rows, k_line); }
  bool operator==(const RowAllocator&) const = default;
};
/// Rows of k_lanes numbers.
template <class Real>
using Rows = std::vector<Real, RowAllocator<Real>>;

/// Where a strand's chain is. `anchor`: the last vertex that the head carries, counted from the strand's first.
struct ChainPlace {
  std::uint32_t block = 0, lane = 0, anchor = 0;
  bool has_links = false;
};

/// Where a block's rows begin (in rows of 16 numbers), and how many of its lanes are strands; the rest repeat lane 0.
struct BlockPlace {
  std::uint32_t links = 0, first_vertex = 0, strands = 0, unused = 0;
};

/// Segments no longer than 1e-7 of the strand are welded: their ends are one vertex of the chain. Masses are half of
/// the adjacent rest lengths.
template <class Real>
struct Chains {
  std::vector<ChainPlace> places;              ///< one per strand
  std::vector<std::uint32_t> links_of_vertex;  ///< one per vertex of the groom: its vertex in the chain, 0 = carried
  std::vector<BlockPlace> blocks;
  Rows<Real> rest, state, strand;
  std::uint32_t longest = 0;  ///< links of the longest chain

  ChainBlock<Real> block(std::size_t index, Real* scratch);
  /// Whether any vertex of the block, predicted at most a tenth past its reach, could be inside the sphere.
  bool within_reach(std::size_t block, const LinkSphere<Real>& sphere, double pearl) const;
  /// A row of a chain's vertex (0: the anchor).
  Real* state_at(std::size_t block, std::size_t vertex, std::size_t field) {
    return state.data() + ((blocks[block].first_vertex + vertex) * state_row::count + field) * k_lanes;
  }
  const Real* rest_at(std::size_t block, std::size_t vertex, std::size_t field) const {
    return rest.data() + ((blocks[block].first_vertex + vertex) * rest_row::count + field) * k_lanes;
  }
  Real* strand_at(std::size_t block, std::size_t field) {
    return strand.data() + (block * strand_row::count + field) * k_lanes;
  }
  const Real* strand_at(std::size_t block, std::size_t field) const {
    return strand.data() + (block * strand_row::count + field) * k_lanes;
  }
};

/// The vector that begins at a row.
template <class Real>
glm::dvec3 vector_at(const Real* row, std::size_t lane) {
  return {row[lane], row[k_lanes + lane], row[2 * k_lanes + lane]};
}
template <class Real>
void put_vector(Real* row, std::size_t lane, const glm::dvec3& v) {
  for (std::size_t c = 0; c < 3; ++c) row[c * k_lanes + lane] = Real(v[int(c)]);
}

/// State::tensions: `numbers` holds the state's rows of the chains.
template <class Real>
std::vector<float> tensions_of(const Chains<Real>& chains, const strands::Groom& rest, std::span<const Real> numbers);

/// At rest in rest space.
template <class Real>
Chains<Real> make_chains(const strands::Groom& groom, const ChainSettings& settings);

}  // namespace cuticle::sim::chains
