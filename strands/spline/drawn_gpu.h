#pragma once
// The strands that a frame draws, on the device, from where the control strands are.
#include <vector>

#include "gpu/device.h"
#include "strands/spline/drawn_parts.h"

#include <glm/mat3x3.hpp>

namespace cuticle::strands {

/// How control vertices move: vec4 each, velocities in m/s, or where they were `since` > 0 seconds before.
struct ControlMotion {
  const gpu::Buffer* values = nullptr;
  float since = 0;
};

/// All strands have as many vertices, vertices_per_strand(); one that is shorter ends in vertices of its tip.
class DrawnStrands {
 public:
  virtual ~DrawnStrands() = default;
  /// `control_positions`: vec4 per control vertex, world metres, the fourth component unused. `turn`: of the head, from
  /// the rest pose.
  virtual Result<void> record(gpu::Commands& commands, const gpu::Buffer& control_positions, const glm::mat3& turn) = 0;
  /// F2: how the drawn vertices move; for one that was made for velocities.
  virtual Result<void> record_velocities(gpu::Commands& commands, const gpu::Buffer& control_positions,
                                         const ControlMotion& motion, const glm::mat3& turn) = 0;
  virtual const gpu::Buffer& vertices() const = 0;    ///< vec4 (position, radius)
  virtual const gpu::Buffer& tangents() const = 0;    ///< vec4 (unit tangent, fraction of length root -> tip)
  virtual const gpu::Buffer& velocities() const = 0;  ///< vec4, m/s; empty where none are asked for
  virtual const gpu::Buffer& segments() const = 0;    ///< uint: first vertex of each segment
  virtual std::uint32_t strand_count() const = 0;
  virtual std::uint32_t vertices_per_strand() const = 0;
  std::uint32_t vertex_count() const { return strand_count() * vertices_per_strand(); }
  std::uint32_t segment_count() const { return strand_count() * (vertices_per_strand() - 1); }
};

/// Vertices, tangents or velocities as a shader reads them at a binding (drawn.glsl).
inline gpu::TexelBinding drawn_texels(std::uint32_t binding) { return {binding, gpu::TextureFormat::rgba32f}; }

/// A run of drawn strands of which one binding of a storage buffer holds so many bytes a vertex (drawn_parts.h).
struct StrandPart {
  std::uint32_t first, count, vertices_per_strand, bytes;
  /// What a buffer of all strands' vertices has of them.
  gpu::Buffer of(const gpu::Buffer& all) const;
};
std::vector<StrandPart> strand_parts(const gpu::DeviceInfo& device, std::uint32_t strands,
                                     std::uint32_t vertices_per_strand, std::uint32_t bytes = k_vertex_bytes);

/// The segments of strands of equal size: segment k of a strand begins at its vertex k.
std::vector<std::uint32_t> first_vertices(std::size_t strands, std::size_t vertices);

}  // namespace cuticle::strands
