#pragma once
// Curves and triangles for rays: the only user of Embree.
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// A crossing of a ray with a fibre (entry and exit of one cylinder, and overlapping joints of one strand, count once).
struct Crossing {
  std::uint32_t strand = 0;
  float entry = 0, exit = 0;  ///< distances along the ray, metres
};

/// A ray-traceable groom (round linear curves). Queries are thread-safe and deterministic.
class RayGroom {
 public:
  static Result<std::unique_ptr<RayGroom>> build(const Groom& groom);
  ~RayGroom();
  /// All distinct crossings from origin (distance 0) along the unit direction, sorted by (entry, strand); `crossings`
  /// is cleared.
  void all_crossings(const glm::dvec3& origin, const glm::dvec3& direction, std::vector<Crossing>& crossings) const;

 private:
  struct Impl;
  explicit RayGroom(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cuticle::strands
