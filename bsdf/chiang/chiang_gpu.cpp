#include <cuticle/bsdf/model_gpu.h>

#include <evaluate_chiang.spv.h>
#include <sample_chiang.spv.h>

namespace cuticle::bsdf::chiang {

const GpuModel& gpu_entry() {
  static const GpuModel model{.name = "chiang", .evaluate_spirv = evaluate_chiang, .sample_spirv = sample_chiang};
  return model;
}

}  // namespace cuticle::bsdf::chiang
