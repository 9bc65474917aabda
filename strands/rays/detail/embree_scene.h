#pragma once
// A tree over strands and meshes: what RayGroom and RayScene have in common; for the sources of strands/rays alone.
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/result.h"
#include "strands/curve_kind.h"
#include "strands/groom.h"
#include "strands/mesh.h"
#include "strands/rays/detail/embree.h"

namespace cuticle::strands {

/// A segment of a strand, by its first vertex.
struct RaySegment {
  std::uint32_t first = 0, strand = 0;
};
/// The segments that have a length, or those that have none.
std::vector<RaySegment> segments_of(const Groom& groom, bool with_length);
/// Position and radius of every vertex.
std::vector<glm::vec4> spheres_of(const Groom& groom);

/// From `origin` on, without an end.
RTCRay ray_of(const glm::dvec3& origin, const glm::dvec3& direction);

class EmbreeScene {
 public:
  EmbreeScene() = default;
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene();

  /// Error: internal, where Embree gives no device.
  Result<void> open(RTCBuildQuality quality);
  /// Geometries by a number of the caller's; nothing where there is nothing in them. Every hit goes through `filter`.
  /// `spheres_at_end`: at time 1; empty: nothing moves.
  void add_segments(std::span<const glm::vec4> spheres, std::span<const glm::vec4> spheres_at_end,
                    std::span<const RaySegment> segments, unsigned id, RTCFilterFunctionN filter);
  /// Spans of any kind but the cone: `first` of each in `controls`, position and radius.
  void add_curves(CurveKind kind, std::span<const glm::vec4> controls, std::span<const glm::vec4> controls_at_end,
                  std::span<const std::uint32_t> first, unsigned id, RTCFilterFunctionN filter);
  void add_points(std::span<const glm::vec4> spheres, std::span<const RaySegment> points, unsigned id,
                  RTCFilterFunctionN filter);
  /// `positions_at_end`: of the mesh's vertices at time 1; empty: it stands.
  void add_mesh(const Mesh& mesh, std::span<const glm::vec3> positions_at_end, unsigned id, RTCFilterFunctionN filter);
  /// Builds the tree. Errors: out_of_memory, naming the segments; internal.
  Result<void> commit(std::size_t segments);
  RTCScene scene() const { return scene_; }
  /// Whether the line enters the box around all that was added, at any time; after `commit`.
  bool may_meet(const glm::dvec3& origin, const glm::dvec3& direction) const;
  std::size_t memory_bytes() const { return bytes_; }

 private:
  void attach(RTCGeometry geometry, unsigned id, RTCFilterFunctionN filter);

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  glm::dvec3 lower_{0}, upper_{0};
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace cuticle::strands
