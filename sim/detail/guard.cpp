#include <cuticle/sim/detail/guard.h>

#include <array>
#include <cmath>

namespace cuticle::sim::detail {
namespace {

/// Nought in every lane whose numbers are all finite: what is not times nought is not a number.
template <class Real>
std::array<Real, k_lanes> noughts(Chains<Real>& chains, std::size_t block) {
  std::array<Real, k_lanes> sums{};
  const Real* row = chains.state_at(block, 1, 0);
  for (std::size_t rows = chains.blocks[block].links * std::size_t(state_row::count); rows > 0; --rows, row += k_lanes)
    for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane) sums[lane] += row[lane] * Real(0);
  return sums;
}

template <class Real>
void reset_lane(Chains<Real>& chains, std::size_t block, std::size_t lane, const Placing& placing) {
  const glm::dvec3 anchor = vector_at(chains.strand_at(block, strand_row::anchor), lane);
  for (std::size_t i = 0; i <= chains.blocks[block].links; ++i) {
    const glm::dvec3 target = vector_at(chains.rest_at(block, i, rest_row::target), lane);
    for (int field : {state_row::here, state_row::before})
      put_vector(chains.state_at(block, i, std::size_t(field)), lane, placing.turned(target));
    for (int field : {state_row::velocity, state_row::velocity_before})
      put_vector(chains.state_at(block, i, std::size_t(field)), lane, placing.velocity(anchor + target));
    chains.state_at(block, i, state_row::tension)[lane] = 0;
  }
  chains.strand_at(block, strand_row::guarded)[lane] = Real(k_was_reset);
}

}  // namespace

template <class Real>
void reset_broken_lanes(Chains<Real>& chains, std::size_t block, const Placing& placing) {
  const std::array<Real, k_lanes> sums = noughts(chains, block);
  for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
    if (!std::isfinite(sums[lane])) reset_lane(chains, block, lane, placing);
}
template void reset_broken_lanes<float>(Chains<float>&, std::size_t, const Placing&);
template void reset_broken_lanes<double>(Chains<double>&, std::size_t, const Placing&);

}  // namespace cuticle::sim::detail
