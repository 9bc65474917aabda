#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_huang.spv.h>
#include <sample_huang.spv.h>

namespace cuticle::bsdf::huang {

const GpuModel& gpu_entry() {
  static const GpuModel model{.name = "huang", .evaluate_spirv = evaluate_huang, .sample_spirv = sample_huang};
  return model;
}

}  // namespace cuticle::bsdf::huang
