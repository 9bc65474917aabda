#include <cuticle/sim/detail/guard.h>

#include <cmath>

namespace cuticle::sim::detail {
namespace {

template <class Real>
bool finite(Chains<Real>& chains, std::size_t block, std::size_t lane) {
  bool good = true;
  for (std::size_t i = 1; i <= chains.blocks[block].links; ++i)
    for (std::size_t field = 0; field < std::size_t(state_row::count); ++field)
      good = good && std::isfinite(chains.state_at(block, i, field)[lane]);
  return good;
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
  for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
    if (!finite(chains, block, lane)) reset_lane(chains, block, lane, placing);
}
template void reset_broken_lanes<float>(Chains<float>&, std::size_t, const Placing&);
template void reset_broken_lanes<double>(Chains<double>&, std::size_t, const Placing&);

}  // namespace cuticle::sim::detail
