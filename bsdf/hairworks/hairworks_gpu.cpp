#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_hairworks.spv.h>
#include <sample_hairworks.spv.h>

namespace cuticle::bsdf::hairworks {

const GpuModel& gpu_entry() {
  static const GpuModel model{
      .name = "hairworks", .evaluate_spirv = evaluate_hairworks, .sample_spirv = sample_hairworks};
  return model;
}

}  // namespace cuticle::bsdf::hairworks
