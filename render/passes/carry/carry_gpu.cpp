#include "render/generating_gpu.h"

namespace cuticle::render::carry {

namespace {

Result<void> record(gpu::Commands& commands, const Resources& resources) {
  if (const auto* const character = resources.find<PosedCharacter>())
    character->hair->record(commands, character->skin->positions(), character->skin->normals());
  return {};
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"carry", recorded_by<record>};
  return table;
}

}  // namespace cuticle::render::carry
