#pragma once
// What the shaders that shade strands read in a frame: constants, the transmittance of all lights in one buffer,
// tables or what stands in place of them.
#include <optional>

#include "render/strand_shading/direct_gpu.h"
#include "render/strand_shading/frame_gpu.h"
#include "render/strand_shading/gathered_transmittance_gpu.h"

namespace cuticle::render::strand_shading {

class ShadingInputs {
 public:
  /// `variation`, `tip_variation` and `ambient` are those of the pass 'lines', however strands are drawn.
  static Result<ShadingInputs> make(std::shared_ptr<gpu::Device> device, const Resources& resources);
  /// GpuPass::take_parameters.
  Result<bool> take_parameters(const Resources& resources);
  /// Sets the frame's view.
  Frame& update(const Resources& resources);
  /// Uploads the constants and records the copies of the lights' transmittance, and the model's formulas where the
  /// scene wants them in place of tables or what stands in place of them.
  /// `listed`: seen_vertices::SeenVertices::list, of whose vertices the formulas are evaluated alone; null: of all.
  Result<void> record(gpu::Commands& commands, const Resources& resources, const gpu::Buffer* listed = nullptr);

  const gpu::Buffer& frame() const { return frame_buffer_; }
  const gpu::Buffer& transmittance() const { return transmittance_.buffer(); }
  /// S of each light at each vertex (scattered.glsl); another buffer where tables are read.
  const gpu::Buffer& scattered() const { return direct_ ? direct_->scattered() : frame_buffer_; }
  const gpu::Texture* table(const Resources& resources, std::size_t index) const;

 private:
  std::shared_ptr<gpu::Device> device_;
  gpu::Buffer frame_buffer_;
  GatheredTransmittance transmittance_;
  gpu::Texture no_table_;  ///< bound where the scene has no light, so that nothing is looked up
  Frame frame_{};
  std::optional<DirectScattering> direct_;
};

}  // namespace cuticle::render::strand_shading
