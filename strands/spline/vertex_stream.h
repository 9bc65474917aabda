#pragma once
// The vertex buffer of drawn strands, made anew each frame on the CPU: the twin of StrandGenerator (smooth_gpu.h).
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "strands/groom.h"

namespace cuticle::strands {

/// N4 and N5 for one frame after another: nothing is allocated after the first, and all cores work, each on vectors
/// along a strand. Positions, tangents and fractions of length are those of the kernels, within float rounding
/// (vertex_stream_test); 200,000 strands of 36 vertices: bench/strands_frame.
class VertexStream {
 public:
  /// `hairs`, `weights`: per drawn strand its three control strands, and their weights of sum 1. `radius`: of a drawn
  /// strand at its root, metres; half of it at the tip. Error: bad_input naming the strand whose hair is not there, a
  /// control strand without a vertex, or `vertices_per_strand` outside 2 .. k_max_vertices.
  static Result<VertexStream> create(const Groom& control, int vertices_per_strand,
                                     std::span<const std::array<std::uint32_t, 3>> hairs,
                                     std::span<const glm::vec3> weights, float radius);
  /// From this frame's control positions, as many as `control` had.
  void update(std::span<const glm::vec3> control_positions);
  std::span<const glm::vec4> vertices() const { return vertices_; }  ///< (position, radius)
  std::span<const glm::vec4> tangents() const { return tangents_; }  ///< (unit tangent, fraction of length)
  /// Bytes held, beside what was given to create().
  std::size_t bytes() const;

 private:
  void smooth_hair(std::size_t hair, std::span<const glm::vec3> control_positions);
  void draw_strand(std::size_t strand);

  std::size_t size_ = 0;  ///< vertices of a strand
  float radius_ = 0;
  std::vector<std::uint32_t> offsets_;
  std::vector<std::array<std::uint32_t, 3>> hairs_;
  std::vector<glm::vec3> weights_;
  std::vector<float> smoothed_;  ///< per control strand four rows of `size_`: x, y, z, fraction of length
  std::vector<glm::vec4> vertices_, tangents_;
};

}  // namespace cuticle::strands
