#pragma once
// A model's own formulas at the vertices of strands, in place of lookup tables.
#include "bsdf/model_gpu.h"
#include "render/pass_gpu.h"

namespace cuticle::render::strand_shading {

class DirectScattering {
 public:
  /// Errors: bad_input where the model, with these parameters, is a function of h, which a vertex does not know, or has
  /// no kernel; what the device says.
  static Result<DirectScattering> make(gpu::Device& device, const Resources& resources);
  /// Of the material as it is now. Errors: as make.
  Result<void> take_parameters(gpu::Device& device, const Resources& resources);
  /// S of every light at every vertex, or at those of a list (seen_vertices::SeenVertices::list) in its order; `frame`
  /// is that of frame.glsl.
  void record(gpu::Commands& commands, const Resources& resources, const gpu::Buffer& frame,
              const gpu::Buffer* listed) const;
  /// rgb per light and vertex, or place in the list.
  const gpu::Buffer& scattered() const { return scattered_; }

 private:
  DirectScattering(bsdf::GpuEvaluator evaluator, gpu::Kernel angles)
      : evaluator_(std::move(evaluator)), angles_(std::move(angles)) {}
  void record_light(gpu::Commands& commands, const Resources& resources, const gpu::Buffer& frame,
                    const gpu::Buffer* listed, std::uint32_t light) const;

  bsdf::GpuEvaluator evaluator_;
  gpu::Kernel angles_;
  gpu::Buffer parameters_, points_, of_light_, scattered_;
};

}  // namespace cuticle::render::strand_shading
