#include "sim/exact/exact.h"

#include "core/instruction_set.h"
#include "sim/chains/chain_solver.h"
#include "sim/exact/kernel.h"

namespace cuticle::sim::exact {

extern const Kernels kernels_baseline, kernels_avx2, kernels_avx512;

const Kernels& best_kernels() {
#if defined(CUTICLE_HAS_WIDE_SETS)
  return widest(kernels_baseline, kernels_avx2, kernels_avx512);
#else
  return kernels_baseline;
#endif
}

chains::ChainSettings make_settings(const registry::ParameterValues& values, const EffectBlocks& effects) {
  const Exact solver = registry::from_values<Exact>(values);
  chains::ChainSettings settings = chains::make_chain_settings(solver, effects);
  settings.clamped_vertices = solver.clamped_vertices;
  settings.shape_stiffness = solver.shape_stiffness;
  settings.shape_tip = solver.shape_tip;
  return settings;
}

Result<std::unique_ptr<Solver>> create(const strands::Groom& rest, const registry::ParameterValues& solver,
                                       const EffectBlocks& effects) {
  CUTICLE_TRY(strands::validate(rest));
  const chains::ChainSettings settings = make_settings(solver, effects);
  const Kernels& kernels = best_kernels();
  if (chains::computes_in_double(settings))
    return chains::make_chain_solver<double>(
        rest, settings, chains::make_chains<double>(rest, settings),
        {.free = kernels.advance_double, .touching = kernels.advance_double, .own = {}});
  const auto& advance = kernels.advance[settings.shape_stiffness > 0 || settings.clumping];
  return chains::make_chain_solver<float>(rest, settings, chains::make_chains<float>(rest, settings),
                                          {.free = advance[0], .touching = advance[1], .own = {}});
}

}  // namespace cuticle::sim::exact
