#include "render/generating_gpu.h"

namespace cuticle::render::skin {

namespace {

Result<void> record(gpu::Commands& commands, const Resources& resources) {
  const auto* const character = resources.find<PosedCharacter>();
  return character ? character->skin->record(commands, character->motions, character->method) : Result<void>{};
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"skin", recorded_by<record>};
  return table;
}

}  // namespace cuticle::render::skin
