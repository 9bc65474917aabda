#include "study/shadows/device_cost.h"

#include <fmt/core.h>

#include "shadows/groom_gpu.h"

namespace cuticle::study {
namespace {

constexpr int k_submissions = 5;

DeviceCost cost_of(const gpu::SubmitCost& submitted, const std::string& device) {
  DeviceCost cost{device, submitted.wall_ms, 0, 0, {}};
  for (std::size_t i = 0; i < submitted.passes.size(); ++i) {
    const gpu::PassCost& pass = submitted.passes[i];
    (i + 1 == submitted.passes.size() ? cost.lookup_ms : cost.build_ms) += pass.gpu_ms;
    cost.passes.emplace_back(pass.name, pass.gpu_ms);
  }
  return cost;
}

Result<gpu::SubmitCost> run_once(gpu::Device& device, shadows::GpuShadow& shadow, const shadows::Casters& casters,
                                 const shadows::GroomOnDevice& groom) {
  gpu::Commands commands = device.record();
  CUTICLE_TRY(shadow.record(commands, groom.strands, casters.alpha, casters.light(), groom.transmittance));
  return device.submit(std::move(commands));
}

/// Until the map has room for all that casts, or says what it lacks.
Result<shadows::MapRoom> make_room(gpu::Device& device, shadows::GpuShadow& shadow, const shadows::Casters& casters,
                                   const shadows::GroomOnDevice& groom) {
  for (;;) {
    CUTICLE_TRY(run_once(device, shadow, casters, groom));
    CUTICLE_ASSIGN(shadows::MapRoom room, shadow.settle());
    if (room.holds) return room;
  }
}

/// The least by wall clock; the last pass of a method is its lookup.
Result<DeviceCost> time_shadow(gpu::Device& device, shadows::GpuShadow& shadow, const shadows::Casters& casters,
                               const shadows::GroomOnDevice& groom) {
  DeviceCost best;
  for (int i = 0; i <= k_submissions; ++i) {
    CUTICLE_ASSIGN(const gpu::SubmitCost submitted, run_once(device, shadow, casters, groom));
    if (i == 1 || (i > 1 && submitted.wall_ms < best.wall_ms)) best = cost_of(submitted, device.info().name);
  }
  return best;
}

}  // namespace

Result<void> measure_on_device(std::shared_ptr<gpu::Device> device, const shadows::Casters& casters, Progress& progress,
                               Comparison& comparison) {
  if (casters.groom->vertex_count() == casters.groom->strand_count()) return {};
  CUTICLE_ASSIGN(const auto groom, shadows::upload_groom(*device, *casters.groom));
  for (ComparisonRow& row : comparison.rows) {
    const auto method = shadows::find_gpu_method(row.method);
    if (!method) continue;
    const auto shadow = (*method)->create(device, row.values);
    if (shadow) {
      CUTICLE_ASSIGN(const shadows::MapRoom room, make_room(*device, **shadow, casters, *groom));
      if (!room.note.empty()) progress.message(room.note);
      CUTICLE_ASSIGN(row.on_device, time_shadow(*device, **shadow, casters, *groom));
    } else {
      progress.message(fmt::format("{} {} on the device: {}", row.method, row.settings, shadow.error().message));
    }
  }
  return {};
}

}  // namespace cuticle::study
