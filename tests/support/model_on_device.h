#pragma once
// The kernels of models on the device, for tests that compare them with the CPU.
#include <map>

#include "bsdf/model_gpu.h"
#include "gpu/tests/test_device.h"

namespace cuticle::tests {

/// A model's kernel on the one device, made once.
inline bsdf::GpuEvaluator& evaluator_of(const bsdf::Model& model) {
  static std::map<std::string_view, bsdf::GpuEvaluator> evaluators;
  const auto found = evaluators.find(model.entry.name);
  if (found != evaluators.end()) return found->second;
  return evaluators.emplace(model.entry.name, *bsdf::GpuEvaluator::make(*device(), model)).first->second;
}

}  // namespace cuticle::tests
