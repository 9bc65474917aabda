#include "sim/chains/device/chain_solver_gpu.h"
#include "sim/exact/exact.h"

#include <exact_beside_all.spv.h>
#include <exact_free.spv.h>
#include <exact_on_skin.spv.h>
#include <exact_on_skin_beside_all.spv.h>
#include <exact_pulled.spv.h>
#include <exact_pulled_beside_all.spv.h>
#include <exact_pulled_touching.spv.h>
#include <exact_touching.spv.h>

namespace cuticle::sim::exact {
namespace {

Result<std::unique_ptr<GpuSolver>> create_gpu(std::shared_ptr<gpu::Device> device, const strands::Groom& rest,
                                              const registry::ParameterValues& solver, const EffectBlocks& effects) {
  const chains::ChainSettings settings = make_settings(solver, effects);
  CUTICLE_TRY(chains::check_for_gpu(rest, settings));
  chains::ChainGpuProgram program{.name = "exact",
                                  .free = exact_free,
                                  .touching = exact_touching,
                                  .beside_all = exact_beside_all,
                                  .on_skin = exact_on_skin,
                                  .on_skin_beside_all = exact_on_skin_beside_all,
                                  .own = {}};
  if (settings.shape_stiffness > 0 || settings.clumping) {
    program.free = exact_pulled;
    program.touching = exact_pulled_touching;
    program.beside_all = exact_pulled_beside_all;
  }
  return chains::make_chain_solver_gpu(std::move(device), rest, settings, chains::make_chains<float>(rest, settings),
                                       std::move(program));
}

}  // namespace

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"exact", create_gpu};
  return effect;
}

}  // namespace cuticle::sim::exact
