#pragma once
// What a ray meets first among fibres and surfaces.
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/result.h"
#include "strands/curve_kind.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// The fibre that a ray leaves: it does not meet this strand again before it has left it, through all the segments that
/// overlap where it goes.
struct FibreLeft {
  static constexpr std::uint32_t none = 0xffffffff;
  std::uint32_t strand = none, vertex = 0;  ///< vertex: the first of the segment that the ray begins on
  double share = 0;                         ///< of the way along it; of curves alone
};

struct RayHit {
  enum class Kind : std::uint8_t { nothing, fibre, surface };
  Kind kind = Kind::nothing;
  double distance = std::numeric_limits<double>::infinity();  ///< metres
  std::uint32_t strand = 0, vertex = 0;                       ///< of a fibre: the segment's first vertex
  double share = 0;                                           ///< of the way along it; of curves alone
  std::uint32_t surface = 0, triangle = 0;
  glm::dvec2 barycentrics{0};  ///< of a triangle: weights of its 2nd and 3rd corner
};

/// The middle of a fibre that is a curve, beside a hit.
struct CurvePoint {
  glm::dvec3 position{0}, tangent{0};  ///< tangent: as long as the curve is fast, toward the tip
  double radius = 0;
};

/// Fibres as round cones (each segment the hull of the spheres around its ends) or curves, and triangle meshes. A fibre
/// is met where a ray enters it from outside; rays that begin inside one meet it no more until they are out. Distances
/// to fibres are computed in double from the cones and curves themselves; Embree says which to look at. Segments
/// without a length are left out. Queries are thread-safe and deterministic. Test: strands/rays/ray_scene_test.cpp,
/// against a brute-force loop.
class RayScene {
 public:
  struct Impl;
  /// `positions_at_end`: of the groom's vertices at time 1, between which and its own, at time 0, they move evenly;
  /// empty: they stand; `surfaces_at_end`: the same of the surfaces, mesh by mesh, of which a mesh without positions
  /// stands. Errors: internal, where the groom is not valid, or numbers of vertices differ; usage, where Bezier curves
  /// lack vertices; out_of_memory, naming the segments.
  static Result<std::unique_ptr<RayScene>> build(const Groom& groom, std::span<const Mesh> surfaces,
                                                 std::span<const glm::vec3> positions_at_end = {}, CurveKind kind = {},
                                                 std::span<const Mesh> surfaces_at_end = {});
  ~RayScene();
  /// The first hit along the unit direction, at a time from 0 to 1.
  RayHit closest(const glm::dvec3& origin, const glm::dvec3& direction, const FibreLeft& from = {},
                 double time = 0) const;
  /// Whether anything is met before `distance`.
  bool is_blocked(const glm::dvec3& origin, const glm::dvec3& direction, double distance, const FibreLeft& from = {},
                  double time = 0) const;
  /// Of a hit on a fibre, where `kind` is not the cone.
  CurvePoint curve_at(const RayHit& hit, double time = 0) const;
  /// Bytes that Embree holds for its trees and copies.
  std::size_t memory_bytes() const;

 private:
  explicit RayScene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cuticle::strands
