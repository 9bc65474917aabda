#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_scheuermann.spv.h>
#include <sample_scheuermann.spv.h>

namespace cuticle::bsdf::scheuermann {

const GpuModel& gpu_entry() {
  static const GpuModel model{
      .name = "scheuermann", .evaluate_spirv = evaluate_scheuermann, .sample_spirv = sample_scheuermann};
  return model;
}

}  // namespace cuticle::bsdf::scheuermann
