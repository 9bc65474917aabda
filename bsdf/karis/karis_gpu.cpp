#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_karis.spv.h>
#include <sample_karis.spv.h>

namespace cuticle::bsdf::karis {

const GpuModel& gpu_entry() {
  static const GpuModel model{.name = "karis", .evaluate_spirv = evaluate_karis, .sample_spirv = sample_karis};
  return model;
}

}  // namespace cuticle::bsdf::karis
