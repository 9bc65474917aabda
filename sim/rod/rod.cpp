#include "sim/rod/rod.h"

#include "core/instruction_set.h"
#include "sim/chains/chain_solver.h"
#include "sim/rod/holding.h"
#include "sim/rod/kernel.h"

namespace cuticle::sim::rod {

extern const Kernels kernels_baseline, kernels_avx2, kernels_avx512;

namespace {

const Kernels& best_kernels() {
#if defined(CUTICLE_HAS_WIDE_SETS)
  return widest(kernels_baseline, kernels_avx2, kernels_avx512);
#else
  return kernels_baseline;
#endif
}

template <class Real>
Result<std::unique_ptr<Solver>> make(const strands::Groom& rest, const Settings& settings,
                                     const chains::Advance<Real> (&variants)[2][2]) {
  const auto& advance = variants[settings.chain.clumping.has_value()];
  chains::Chains<Real> chains = chains::make_chains<Real>(rest, settings.chain);
  chains::Rows<Real> hinges = make_held_hinges(chains, settings).rows;
  return chains::make_chain_solver<Real>(rest, settings.chain, std::move(chains),
                                         {.free = advance[0],
                                          .touching = advance[1],
                                          .scratch_rows = rod_row::count,
                                          .own_rows = hinge_row::count,
                                          .own = std::move(hinges)});
}

}  // namespace

Settings make_settings(const registry::ParameterValues& values, const EffectBlocks& effects) {
  const Rod rod = registry::from_values<Rod>(values);
  Settings settings{.chain = chains::make_chain_settings(rod, effects), .stiffness = {}};
  settings.chain.clamped_vertices = rod.clamped_vertices;
  settings.stiffness.bending = rod.young_modulus * rod.fibre_radius * rod.fibre_radius / (4 * rod.density);
  settings.stiffness.twisting = rod.shear_modulus * rod.fibre_radius * rod.fibre_radius / (2 * rod.density);
  if (rod.sag_free) settings.balanced_gravity = settings.chain.gravity;
  settings.stiffen_at_most = rod.stiffen_at_most;
  return settings;
}

Result<std::unique_ptr<Solver>> create(const strands::Groom& rest, const registry::ParameterValues& solver,
                                       const EffectBlocks& effects) {
  CUTICLE_TRY(strands::validate(rest));
  const Settings settings = make_settings(solver, effects);
  const Kernels& kernels = best_kernels();
  if (chains::computes_in_double(settings.chain)) return make<double>(rest, settings, kernels.advance_double);
  return make<float>(rest, settings, kernels.advance);
}

}  // namespace cuticle::sim::rod
