#pragma once
// N20: casters that are no hair: clouds of points (smoke, dust) and of segments (leaves, needles, rain).
#include <span>

#include <glm/vec3.hpp>

#include "strands/groom.h"

namespace cuticle::shadows {

/// Points as casters: each covers the area of a disc of its radius seen from any side, which maps deposit as a
/// rectangle of that area. Points and radii in metres, one radius per point, or one for all. They are segments without
/// a length, spheres to the rays of `truth`, and not seen by `voxel`.
strands::Groom point_casters(std::span<const glm::vec3> points, std::span<const float> radii);

/// Segments as casters, each a cylinder with round ends, from ends[2 i] to ends[2 i + 1], metres; one radius per
/// segment, or one for all.
strands::Groom segment_casters(std::span<const glm::vec3> ends, std::span<const float> radii);

/// A ball of smoke: points of one radius, normally distributed with a standard deviation, metres; the same each time.
strands::Groom smoke(std::size_t points, double deviation, float radius);

/// A crown of leaves: needles of one length and radius in all directions, distributed as the smoke.
strands::Groom foliage(std::size_t leaves, double deviation, double length, float radius);

}  // namespace cuticle::shadows
