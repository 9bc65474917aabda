#pragma once
// Strands drawn as they are given (place.h), on the device.
#include <memory>

#include "strands/spline/drawn_gpu.h"
#include "strands/spline/place.h"

namespace cuticle::strands {

inline constexpr std::uint32_t k_longest_placed = 16384;  ///< vertices

/// One dispatch "place_strands" of one thread per strand for each part of the strands (drawn_parts.h): positions and
/// radii of the strands themselves are those of the control strands, bit by bit; a follow hair's offset turns with the
/// head and with its guide's first segment (place_gpu_test). Velocities: "place_velocities", likewise.
class StrandPlacer : public DrawnStrands {
 public:
  /// `moves`: whether there is room for velocities; `parts` as for place(). Errors: bad_input for a strand without a
  /// guide, a guide of fewer than 2 or more than k_longest_placed vertices; out_of_memory names the device's limit.
  static Result<std::unique_ptr<StrandPlacer>> create(std::shared_ptr<gpu::Device> device, const Groom& control,
                                                      std::span<const PlacedStrand> strands, bool moves,
                                                      std::uint32_t parts = 1);
  Result<void> record(gpu::Commands& commands, const gpu::Buffer& control_positions, const glm::mat3& turn) override;
  Result<void> record_velocities(gpu::Commands& commands, const gpu::Buffer& control_positions,
                                 const ControlMotion& motion, const glm::mat3& turn) override;
  const gpu::Buffer& vertices() const override { return vertices_; }
  const gpu::Buffer& tangents() const override { return tangents_; }
  const gpu::Buffer& velocities() const override { return velocities_; }
  const gpu::Buffer& segments() const override { return segments_; }
  std::uint32_t strand_count() const override { return strands_; }
  std::uint32_t vertices_per_strand() const override { return size_; }

 private:
  StrandPlacer() = default;
  Result<void> upload(gpu::Device& device, const Groom& control, std::span<const PlacedStrand> strands);
  Result<void> make_kernels(gpu::Device& device, bool moves);

  std::uint32_t strands_ = 0, size_ = 2, parts_ = 1;
  std::vector<StrandPart> written_;  ///< a dispatch each
  gpu::Kernel place_, place_velocity_;
  gpu::Buffer rows_, radii_, vertices_, tangents_, segments_, velocities_;
};

}  // namespace cuticle::strands
