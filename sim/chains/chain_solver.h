#pragma once
// A solver of rigid links on the CPU, 16 strands at a time: what differs between such solvers is their program.
#include <memory>

#include "sim/chains/chains.h"

namespace cuticle::sim::chains {

/// The units of one instruction set, the scratch rows that they need, and the rows that they add to a vertex.
template <class Real>
struct ChainProgram {
  Advance<Real> free = nullptr, touching = nullptr;  ///< without and with spheres
  int scratch_rows = scratch_row::count, own_rows = 0;
  Rows<Real> own;  ///< own_rows * k_lanes for each vertex of the chains
};

/// Runs blocks in parallel; the result is bit-identical at any number of threads, and a strand's does not depend on
/// those beside it, but for rounding beside spheres: a block meets the spheres that any of its 16 strands can reach,
/// and without one it runs the program without spheres.
/// Error: that of StrandInteraction::create.
template <class Real>
Result<std::unique_ptr<Solver>> make_chain_solver(const strands::Groom& rest, const ChainSettings& settings,
                                                  Chains<Real> chains, ChainProgram<Real> program);

}  // namespace cuticle::sim::chains
