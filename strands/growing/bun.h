#pragma once
// The ring of hair round a tie: where hair runs to, and its way over the ring.
#include <vector>

#include "strands/growing/grooming.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// A bun placed on a head.
class BunFrame {
 public:
  /// The tie is the mesh vertex that lies nearest to the bun's direction as seen from `center`.
  BunFrame(const Bun& bun, const Mesh& mesh, const glm::dvec3& center);
  /// Direction to the tie, unit.
  glm::dvec3 toward(const glm::dvec3& point) const;
  /// Whether the ring begins here.
  bool reaches(const glm::dvec3& point) const;
  /// From the last of `points` onto the ring's outer side, over its top and into its hole. `depth`, 0 .. 1: how deep
  /// below the ring's surface.
  void append_ring(double depth, std::vector<glm::dvec3>& points) const;

 private:
  glm::dvec3 ring_point(double azimuth, double place, double depth) const;

  Bun bun_;
  glm::dvec3 tie_{0}, axis_{0, 1, 0}, across_{1, 0, 0}, beside_{0, 0, 1};
};

}  // namespace cuticle::strands
