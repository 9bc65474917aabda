#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_yan_fur.spv.h>
#include <sample_yan_fur.spv.h>

namespace cuticle::bsdf::yan_fur {

const GpuModel& gpu_entry() {
  static const GpuModel model{.name = "yan_fur", .evaluate_spirv = evaluate_yan_fur, .sample_spirv = sample_yan_fur};
  return model;
}

}  // namespace cuticle::bsdf::yan_fur
