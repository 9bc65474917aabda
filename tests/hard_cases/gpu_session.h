#pragma once
// What the cases of one run share on the device: compiling a model's kernel takes seconds on software Vulkan.
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "bsdf/model_gpu.h"
#include "lut/table_set.h"

namespace cuticle::hard_cases {

struct GpuSession {
  std::shared_ptr<gpu::Device> device;
  std::map<std::string_view, bsdf::GpuEvaluator> evaluators;  ///< by model name
  std::map<std::string, lut::TableSet> tables;                ///< by model, settings, layout and size
};

}  // namespace cuticle::hard_cases
