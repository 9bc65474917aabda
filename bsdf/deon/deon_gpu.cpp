#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_deon.spv.h>
#include <sample_deon.spv.h>

namespace cuticle::bsdf::deon {

const GpuModel& gpu_entry() {
  static const GpuModel model{.name = "deon", .evaluate_spirv = evaluate_deon, .sample_spirv = sample_deon};
  return model;
}

}  // namespace cuticle::bsdf::deon
