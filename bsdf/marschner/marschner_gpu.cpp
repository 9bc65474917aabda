#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_marschner.spv.h>
#include <sample_marschner.spv.h>

namespace cuticle::bsdf::marschner {

const GpuModel& gpu_entry() {
  static const GpuModel model{
      .name = "marschner", .evaluate_spirv = evaluate_marschner, .sample_spirv = sample_marschner};
  return model;
}

}  // namespace cuticle::bsdf::marschner
