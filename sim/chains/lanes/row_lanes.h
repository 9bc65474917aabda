#pragma once
// The rows of a block of strands in packs, for the units of one instruction set of the solvers of rigid links: those
// are compiled several times with CUTICLE_BATCH, and no symbol may leave them, hence the unnamed namespace. `Real` is a
// pack of as many strands' numbers as a register holds; a block is walked in so many parts.
#include "core/join.h"
#include "sim/chains/chain_rows.h"
#include "sim/chains/lanes/pack.h"

namespace cuticle::sim::chains {
namespace {

constexpr int S = k_lanes;  ///< from row to row

template <class Real>
using Vector = glm::vec<3, Real>;

template <class Real>
[[gnu::always_inline]] inline Real number_at(const typename Real::Scalar* row) {
  Real pack;
  std::memcpy(&pack.all, row, sizeof pack.all);
  return pack;
}
template <class Real, int Stride = S>
[[gnu::always_inline]] inline Vector<Real> vector_at(const typename Real::Scalar* row) {
  return {number_at<Real>(row), number_at<Real>(row + Stride), number_at<Real>(row + 2 * Stride)};
}
template <class Real, int Stride = S>
[[gnu::always_inline]] inline void put(typename Real::Scalar* row, Real number) {
  std::memcpy(row, &number.all, sizeof number.all);
}
template <class Real, int Stride = S>
[[gnu::always_inline]] inline void put(typename Real::Scalar* row, const Vector<Real>& v) {
  put<Real>(row, v.x);
  put<Real>(row + Stride, v.y);
  put<Real>(row + 2 * Stride, v.z);
}

/// Rows of vertex i. Those of the scratch are no longer than a register, so that more of them stay near.
template <class Real>
struct VertexRows {
  using Scalar = typename Real::Scalar;
  const Scalar* rest;
  Scalar *state, *scratch;
  [[gnu::always_inline]] VertexRows(const ChainBlock<Scalar>& block, int i)
      : rest(block.rest + i * rest_row::count * S),
        state(block.state + i * state_row::count * S),
        scratch(block.scratch + i * block.scratch_rows * Real::count) {}
  [[gnu::always_inline]] Real rest_at(int row) const { return number_at<Real>(rest + row * S); }
  [[gnu::always_inline]] Real state_at(int row) const { return number_at<Real>(state + row * S); }
  [[gnu::always_inline]] Real scratch_at(int row) const { return number_at<Real>(scratch + row * Real::count); }
  [[gnu::always_inline]] Vector<Real> rest_vector(int row) const { return vector_at<Real>(rest + row * S); }
  [[gnu::always_inline]] Vector<Real> state_vector(int row) const { return vector_at<Real>(state + row * S); }
  [[gnu::always_inline]] Vector<Real> scratch_vector(int row) const {
    return vector_at<Real, Real::count>(scratch + row * Real::count);
  }
  template <class T>
  [[gnu::always_inline]] void put_state(int row, const T& value) const {
    put<Real>(state + row * S, value);
  }
  template <class T>
  [[gnu::always_inline]] void put_scratch(int row, const T& value) const {
    put<Real, Real::count>(scratch + row * Real::count, value);
  }
};

template <class Real>
[[gnu::always_inline]] inline ChainVertex<Real> chain_vertex(const VertexRows<Real>& v) {
  return {v.state_vector(state_row::here), v.state_vector(state_row::before), v.state_vector(state_row::velocity),
          v.state_vector(state_row::velocity_before)};
}

/// The state before the substep is kept, and `from` where the velocity will be.
template <class Real>
[[gnu::always_inline]] inline void keep_before(const VertexRows<Real>& v, const ChainVertex<Real>& vertex,
                                               const StrandStep<Real>& strand, const Vector<Real>& from) {
  v.put_state(state_row::before, vertex.here - strand.root_step);
  v.put_state(state_row::velocity_before, vertex.velocity);
  v.put_state(state_row::velocity, from);
}

template <class Real, class Scalar>
[[gnu::always_inline]] inline StrandStep<Real> begin(const ChainBlock<Scalar>& block, const ChainStep<Real>& step) {
  const StrandStep<Real> strand = strand_step(step, vector_at<Real>(block.strand + strand_row::anchor * S),
                                              number_at<Real>(block.strand + strand_row::guarded * S));
  VertexRows<Real>(block, 0).put_state(state_row::before, -strand.root_step);
  return strand;
}

/// The same for all strands.
template <class Real, template <class> class Numbers>
[[gnu::always_inline]] inline Numbers<Real> spread(const Numbers<typename Real::Scalar>& narrow) {
  constexpr std::size_t count = sizeof narrow / sizeof(typename Real::Scalar);
  static_assert(sizeof(Numbers<Real>) == count * sizeof(Real));
  typename Real::Scalar numbers[count];
  std::memcpy(numbers, &narrow, sizeof narrow);
  Real packs[count];
  for (std::size_t k = 0; k < count; ++k) packs[k] = numbers[k];
  Numbers<Real> wide;
  std::memcpy(static_cast<void*>(&wide), packs, sizeof wide);
  return wide;
}

}  // namespace
}  // namespace cuticle::sim::chains
