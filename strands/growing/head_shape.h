#pragma once
// The procedural head as a signed distance: blended ellipsoids. Metres, facing +z, y up, neck joint at the origin.
#include <glm/vec3.hpp>

namespace cuticle::strands {

/// Distance to the head's surface, negative inside, metres; exact only in sign, close to true within a few centimetres.
double head_distance(const glm::dvec3& point);
/// Unit outward normal near the surface.
glm::dvec3 head_normal(const glm::dvec3& point);
/// A point inside from which every ray leaves the head once (the shape is star-shaped about it).
inline constexpr double k_head_center[3] = {0, 0.115, 0.0};
/// First point outside the head along the unit direction from `origin` (inside the head), metres.
glm::dvec3 head_surface_point(const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace cuticle::strands
