#include "sim/chains/sleepers.h"

#include <algorithm>
#include <array>
#include <bit>

#include "sim/chains/guard.h"

namespace cuticle::sim::chains {
namespace {

/// The rows of a block's state, and of its strands.
template <class Real>
std::span<Real> state_rows(Chains<Real>& chains, std::size_t block) {
  return {chains.state_at(block, 0, 0),
          (chains.blocks[block].links + 2) * std::size_t(state_row::count) * std::size_t(k_lanes)};
}
template <class Real>
std::span<Real> strand_rows(Chains<Real>& chains, std::size_t block) {
  return {chains.strand_at(block, 0), std::size_t(strand_row::count) * std::size_t(k_lanes)};
}

template <class Real>
void put_back(std::span<Real> rows, const Rows<Real>& kept, std::uint32_t lanes) {
  for (std::size_t row = 0; row < rows.size(); row += std::size_t(k_lanes))
    for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
      if (lanes >> lane & 1) rows[row + lane] = kept[row + lane];
}

/// Square of the fastest vertex' speed in every lane.
template <class Real>
std::array<Real, k_lanes> fastest(Chains<Real>& chains, std::size_t block) {
  std::array<Real, k_lanes> most{};
  for (std::size_t i = 1; i <= chains.blocks[block].links; ++i) {
    const Real* const v = chains.state_at(block, i, state_row::velocity);
    for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane) {
      const Real x = v[lane], y = v[lane + k_lanes], z = v[lane + 2 * k_lanes];
      most[lane] = std::max(most[lane], x * x + y * y + z * z);
    }
  }
  return most;
}

template <class Real>
void bring_to_rest(Chains<Real>& chains, std::size_t block, std::size_t lane) {
  for (std::size_t i = 1; i <= chains.blocks[block].links; ++i) {
    put_vector(chains.state_at(block, i, state_row::before), lane,
               vector_at(chains.state_at(block, i, state_row::here), lane));
    for (const std::size_t row : {state_row::velocity, state_row::velocity_before})
      put_vector(chains.state_at(block, i, row), lane, glm::dvec3(0));
  }
}

}  // namespace

template <class Real>
std::uint32_t Sleepers<Real>::asleep(const Chains<Real>& chains, std::size_t block) const {
  const Real* const quiet = chains.strand_at(block, strand_row::quiet);
  std::uint32_t lanes = 0;
  for (std::uint32_t lane = 0; lane < chains.blocks[block].strands; ++lane)
    lanes |= std::uint32_t(quiet[lane] >= Real(settings_.time)) << lane;
  return lanes;
}

template <class Real>
bool Sleepers<Real>::begin(Chains<Real>& chains, std::size_t block, std::uint32_t woken, std::span<const Real> own) {
  Kept& kept = kept_.local();
  kept.woken = woken;
  for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane)
    if (woken >> lane & 1) chains.strand_at(block, strand_row::quiet)[lane] = Real(0);
  kept.asleep = asleep(chains, block);
  if (std::uint32_t(std::popcount(kept.asleep)) == chains.blocks[block].strands) return false;
  if (kept.asleep == 0) return true;
  const std::span<Real> state = state_rows(chains, block), strand = strand_rows(chains, block);
  kept.state.assign(state.begin(), state.end());
  kept.strand.assign(strand.begin(), strand.end());
  kept.own.assign(own.begin(), own.end());
  return true;
}

template <class Real>
void Sleepers<Real>::end(Chains<Real>& chains, std::size_t block, double duration, std::span<Real> own) {
  const Kept& kept = kept_.local();
  if (kept.asleep) {
    put_back(state_rows(chains, block), kept.state, kept.asleep);
    put_back(strand_rows(chains, block), kept.strand, kept.asleep);
    put_back(own, kept.own, kept.asleep);
  }
  const std::array<Real, k_lanes> speeds = fastest(chains, block);
  Real* const quiet = chains.strand_at(block, strand_row::quiet);
  const Real* const guarded = chains.strand_at(block, strand_row::guarded);
  for (std::size_t lane = 0; lane < std::size_t(k_lanes); ++lane) {
    if ((kept.asleep | kept.woken) >> lane & 1) continue;
    const bool rests =
        speeds[lane] < Real(settings_.speed) * Real(settings_.speed) && guarded[lane] != Real(k_was_reset);
    quiet[lane] = rests ? quiet[lane] + Real(duration) : Real(0);
    if (quiet[lane] >= Real(settings_.time)) bring_to_rest(chains, block, lane);
  }
}

template <class Real>
std::uint32_t Sleepers<Real>::count(const Chains<Real>& chains) const {
  std::uint32_t strands = 0;
  for (std::size_t block = 0; block < chains.blocks.size(); ++block)
    strands += std::uint32_t(std::popcount(asleep(chains, block)));
  return strands;
}

template class Sleepers<float>;
template class Sleepers<double>;

}  // namespace cuticle::sim::chains
