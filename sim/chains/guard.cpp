#include "sim/chains/guard.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace cuticle::sim::chains {
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

/// From the parent's target to a vertex' own at the link's length, as targets in motion have other lengths. `along`:
/// the direction of the link above, which becomes this one's.
template <class Real>
glm::dvec3 link_at_length(const Chains<Real>& chains, std::size_t block, std::size_t i, std::size_t lane,
                          glm::dvec3& along) {
  const auto target = [&](std::size_t vertex) {
    return vector_at(chains.rest_at(block, vertex, rest_row::target), lane);
  };
  const glm::dvec3 link = target(i) - target(i - 1);
  const double length = glm::length(link);
  if (length > 0) along = link / length;
  return along * double(chains.rest_at(block, i, rest_row::length)[lane]);
}

}  // namespace

template <class Real>
void reset_lane(Chains<Real>& chains, std::size_t block, std::size_t lane, const Placing& placing) {
  const glm::dvec3 anchor = vector_at(chains.strand_at(block, strand_row::anchor), lane);
  glm::dvec3 target(0), along(0, -1, 0);
  for (std::size_t i = 0; i <= chains.blocks[block].links; ++i) {
    if (i > 0) target += link_at_length(chains, block, i, lane, along);
    for (int field : {state_row::here, state_row::before})
      put_vector(chains.state_at(block, i, std::size_t(field)), lane, placing.turned(target));
    for (int field : {state_row::velocity, state_row::velocity_before})
      put_vector(chains.state_at(block, i, std::size_t(field)), lane, placing.velocity(anchor + target));
    chains.state_at(block, i, state_row::tension)[lane] = 0;
  }
  chains.strand_at(block, strand_row::guarded)[lane] = Real(k_was_reset);
}
template void reset_lane<float>(Chains<float>&, std::size_t, std::size_t, const Placing&);
template void reset_lane<double>(Chains<double>&, std::size_t, std::size_t, const Placing&);

template <class Real>
void reset_broken_lanes(Chains<Real>& chains, std::size_t block, const PlacingOf& placing) {
  const std::array<Real, k_lanes> sums = noughts(chains, block);
  for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
    if (!std::isfinite(sums[lane])) reset_lane(chains, block, lane, placing(lane));
}
template void reset_broken_lanes<float>(Chains<float>&, std::size_t, const PlacingOf&);
template void reset_broken_lanes<double>(Chains<double>&, std::size_t, const PlacingOf&);

}  // namespace cuticle::sim::chains
