#pragma once
// Passes whose work the strands' own code records.
#include "render/pass_gpu.h"

namespace cuticle::render {

template <auto record_work>
class RecordedBy : public GpuPass {
 public:
  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    return record_work(commands, resources);
  }
};

/// GpuPassEntry::create of a pass that keeps nothing of its own.
template <auto record_work>
Result<std::unique_ptr<GpuPass>> recorded_by(std::shared_ptr<gpu::Device>, const Resources&) {
  return std::unique_ptr<GpuPass>(std::make_unique<RecordedBy<record_work>>());
}

/// How the drawn vertices move, by what made them.
inline Result<void> record_velocities(gpu::Commands& commands, const Resources& resources) {
  const ControlHairs& hairs = resources.get<ControlHairs>();
  return resources.get<StrandMaker>().strands->record_velocities(commands, *hairs.positions, hairs.motion,
                                                                 glm::mat3(resources.get<Surfaces>().head_transform));
}

}  // namespace cuticle::render
