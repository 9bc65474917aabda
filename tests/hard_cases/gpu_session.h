#pragma once
// What the cases of one run share on the device: compiling a model's kernel takes seconds on software Vulkan.
#include <map>
#include <memory>
#include <string_view>

#include "bsdf/model_gpu.h"

namespace cuticle::hard_cases {

struct GpuSession {
  std::shared_ptr<gpu::Device> device;
  std::map<std::string_view, bsdf::GpuEvaluator> evaluators;  ///< by model name
};

}  // namespace cuticle::hard_cases
