#pragma once
// GPU half of N4 and N5: control positions on the device -> smoothed -> interpolated drawn strands with tangents.
#include <memory>

#include "strands/spline/drawn_gpu.h"
#include "strands/spline/smooth.h"

namespace cuticle::strands {

struct StrandGeneratorInput {
  const Groom* control = nullptr;  ///< rest: offsets, radii
  int vertices_per_strand = 30;
  std::span<const std::array<std::uint32_t, 3>> hairs;  ///< per drawn strand: its three control strands
  std::span<const glm::vec3> weights;                   ///< per drawn strand, sum 1
  float radius = 35e-6f;                                ///< drawn fibre radius, metres, at the root
  float taper = 0.5f;                                   ///< share of it that is gone at the tip
  bool moves = false;                                   ///< whether there is room for velocities
};
/// N4 and N5 on the device: the passes "smooth_strands" (one thread per vertex of a smoothed control hair) and
/// "interpolate_strands" (one thread per run of drawn vertices, tangents included), one dispatch each, the latter for
/// each part of the strands (drawn_parts.h). The formulas are those of bezier.glslh and tangent.glslh, so that
/// smooth(), interpolate() and tangents() on the CPU agree within float rounding (strand_generator_test). Control
/// positions: vec4 per control vertex, world metres, the fourth component unused.
class StrandGenerator : public DrawnStrands {
 public:
  /// Errors: bad_input names the strand whose hair or weight is wrong, or vertices_per_strand
  /// outside 2..k_max_vertices; out_of_memory names the device's limit where the drawn vertices (16 bytes each) pass
  /// its largest buffer of texels.
  static Result<std::unique_ptr<StrandGenerator>> create(std::shared_ptr<gpu::Device> device,
                                                         const StrandGeneratorInput& input);
  ~StrandGenerator() override;
  /// record_smooth, then record_interpolate.
  Result<void> record(gpu::Commands& commands, const gpu::Buffer& control_positions, const glm::mat3& turn) override;
  Result<void> record_velocities(gpu::Commands& commands, const gpu::Buffer& control_positions,
                                 const ControlMotion& motion, const glm::mat3&) override {
    return record_velocities(commands, control_positions, motion);
  }
  Result<void> record_smooth(gpu::Commands& commands, const gpu::Buffer& control_positions);
  Result<void> record_interpolate(gpu::Commands& commands);
  /// F2: how the drawn vertices move, in dispatches named "interpolate_velocities": the derivative by time
  /// of record_smooth and record_interpolate, along the control vertices' velocities, or the mean since they were where
  /// they were (strand_generator_test: 5e-4 m/s off a difference of positions where vertices move at up to .7). Needs
  /// StrandGeneratorInput::moves.
  Result<void> record_velocities(gpu::Commands& commands, const gpu::Buffer& control_positions,
                                 const ControlMotion& motion);
  const gpu::Buffer& velocities() const override;
  const gpu::Buffer& vertices() const override;
  /// The fraction of the length is taken along the control hairs.
  const gpu::Buffer& tangents() const override;
  const gpu::Buffer& segments() const override;
  std::uint32_t strand_count() const override;
  std::uint32_t vertices_per_strand() const override;

 private:
  struct Impl;
  explicit StrandGenerator(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cuticle::strands
