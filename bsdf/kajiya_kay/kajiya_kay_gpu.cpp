#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_kajiya_kay.spv.h>
#include <sample_kajiya_kay.spv.h>

namespace cuticle::bsdf::kajiya_kay {

const GpuModel& gpu_entry() {
  static const GpuModel model{
      .name = "kajiya_kay", .evaluate_spirv = evaluate_kajiya_kay, .sample_spirv = sample_kajiya_kay};
  return model;
}

}  // namespace cuticle::bsdf::kajiya_kay
