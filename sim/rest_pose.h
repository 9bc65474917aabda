#pragma once
// What a solver knows of the strands at rest: the same arrays for the CPU twin and the storage buffers of the kernels.
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "strands/groom.h"

namespace cuticle::sim {

/// Rest pose in the head's space, one entry per vertex.
struct RestPose {
  std::vector<std::uint32_t> offsets;  ///< as strands::Groom::offsets
  std::vector<glm::vec4>
      places;  ///< xyz: position, metres; w: length of the segment towards the root, metres (0 at roots)
  /// x: inverse mass, 0 where the head carries the vertex; mass is the half sum of the adjacent rest lengths over the
  /// strand's mean segment, so that uneven segments weigh what their hair weighs (a lone vertex: 1);
  /// y: arc length from the root over the strand's length, 0 .. 1; z: arc length from the last carried vertex, metres;
  /// w: longest adjacent segment, metres.
  std::vector<glm::vec4> traits;

  std::size_t strand_count() const { return offsets.size() - 1; }
};

/// The first `clamped_vertices` of each strand are carried by the head. Zero-length segments get a mass of at least
/// 1/1000 of the mean.
RestPose make_rest_pose(const strands::Groom& groom, std::uint32_t clamped_vertices);

}  // namespace cuticle::sim
