#pragma once
// Where a ray meets a fibre, in the fibre's own frame.
#include <glm/vec3.hpp>

#include "strands/groom.h"
#include "strands/rays/ray_scene.h"

namespace cuticle::render::reference {

/// A fibre's frame: x along it from root to tip, y and z across; and the offset of the viewer's ray, h in [-1, 1].
struct FibrePoint {
  glm::dvec3 position{0};  ///< on the fibre's surface
  glm::dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  double h = 0;
  double share = 0;  ///< of the way from the segment's first vertex to its second
  strands::FibreLeft from;

  glm::vec3 local(const glm::dvec3& v) const;
  glm::dvec3 world(const glm::vec3& v) const;
};

/// The segment that is met: its ends and the fibre's unit tangents there, where they are at the ray's time.
struct FibreSegment {
  glm::dvec3 begin{0}, end{0}, tangent_at_begin{0}, tangent_at_end{0};
};
FibrePoint fibre_point(const FibreSegment& segment, const strands::RayHit& hit, const glm::dvec3& origin,
                       const glm::dvec3& direction);
/// Of a fibre that is a curve: `curve` is RayScene::curve_at of the hit; `is_flat`: a ribbon, whose offset is the hit's
/// distance from its middle, in radii.
FibrePoint fibre_point(const strands::CurvePoint& curve, bool is_flat, const strands::RayHit& hit,
                       const glm::dvec3& origin, const glm::dvec3& direction);
/// The same of hair that does not move. `tangents`: unit, one per vertex of the hair; between them the fibre's
/// direction is interpolated. The offset is that of the point from the segment's own axis: h = n . (u x w) / |u x w|
/// with n across the axis, u along it, w toward the viewer (docs/conventions.md: the ray meets the fibre at azimuth
/// phi_o + asin h). 0 for a ray along the fibre. Test: fibre_point_test.cpp: for parallel light h is uniform.
FibrePoint fibre_point(const strands::Groom& hair, std::span<const glm::vec3> tangents, const strands::RayHit& hit,
                       const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace cuticle::render::reference
