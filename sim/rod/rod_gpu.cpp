#include "sim/chains/device/chain_solver_gpu.h"
#include "sim/rod/holding.h"
#include "sim/rod/kernel.h"
#include "sim/rod/rod.h"

#include <rod_beside_all.spv.h>
#include <rod_free.spv.h>
#include <rod_on_skin.spv.h>
#include <rod_on_skin_beside_all.spv.h>
#include <rod_touching.spv.h>

namespace cuticle::sim::rod {
namespace {

Result<std::unique_ptr<GpuSolver>> create_gpu(std::shared_ptr<gpu::Device> device, const strands::Groom& rest,
                                              const registry::ParameterValues& solver, const EffectBlocks& effects) {
  const Settings settings = make_settings(solver, effects);
  CUTICLE_TRY(chains::check_for_gpu(rest, settings.chain));
  chains::Chains<float> chains = chains::make_chains<float>(rest, settings.chain);
  chains::Rows<float> hinges = make_held_hinges(chains, settings).rows;
  return chains::make_chain_solver_gpu(std::move(device), rest, settings.chain, std::move(chains),
                                       {.name = "rod",
                                        .free = rod_free,
                                        .touching = rod_touching,
                                        .beside_all = rod_beside_all,
                                        .on_skin = rod_on_skin,
                                        .on_skin_beside_all = rod_on_skin_beside_all,
                                        .scratch_rows = rod_row::count,
                                        .own = std::move(hinges)});
}

}  // namespace

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"rod", create_gpu};
  return effect;
}

}  // namespace cuticle::sim::rod
