#pragma once
// A solver of rigid links on the device: one thread per strand, all substeps of a frame in one dispatch.
#include "sim/chains/chains.h"
#include "sim/solver_gpu.h"

namespace cuticle::sim::chains {

/// What differs between such solvers. `name`: of the solver, and of its pass.
struct ChainGpuProgram {
  std::string_view name;
  /// SPIR-V without colliders, with spheres, with all colliders; interface of chain_kernel.glsl.
  std::span<const std::uint32_t> free, touching, beside_all;
  std::span<const std::uint32_t> on_skin, on_skin_beside_all;  ///< for hair on a skin, without and with all colliders
  int scratch_rows = scratch_row::count;
  Rows<float> own;  ///< the rows that the solver adds to a vertex of the chains, see ChainProgram
};
Result<std::unique_ptr<GpuSolver>> make_chain_solver_gpu(std::shared_ptr<gpu::Device> device,
                                                         const strands::Groom& rest, const ChainSettings& settings,
                                                         Chains<float> chains, ChainGpuProgram program);

/// Error: that of strands::validate; bad_input for an empty groom; usage where double precision is asked for.
Result<void> check_for_gpu(const strands::Groom& rest, const ChainSettings& settings);

}  // namespace cuticle::sim::chains
