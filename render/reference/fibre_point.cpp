#include "render/reference/fibre_point.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::render::reference {

glm::vec3 FibrePoint::local(const glm::dvec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
glm::dvec3 FibrePoint::world(const glm::vec3& v) const {
  return glm::normalize(double(v.x) * x + double(v.y) * y + double(v.z) * z);
}

namespace {

/// Axes of a fibre that runs along `tangent`, which is not zero.
void set_axes(FibrePoint& point, const glm::dvec3& tangent) {
  point.x = tangent;
  const glm::dvec3 other = std::abs(point.x.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  point.y = glm::normalize(glm::cross(point.x, other));
  point.z = glm::cross(point.x, point.y);
}

}  // namespace

FibrePoint fibre_point(const FibreSegment& segment, const strands::RayHit& hit, const glm::dvec3& origin,
                       const glm::dvec3& direction) {
  FibrePoint point{.position = origin + hit.distance * direction, .from = {hit.strand, hit.vertex}};
  const glm::dvec3 &begin = segment.begin, along = segment.end - begin;
  point.share = std::clamp(glm::dot(point.position - begin, along) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec3 axis = glm::normalize(along), away = point.position - begin;
  const glm::dvec3 across = away - glm::dot(away, axis) * axis, side = glm::cross(axis, -direction);
  const double width = glm::length(across) * glm::length(side);
  point.h = width > 0 ? std::clamp(glm::dot(across, side) / width, -1.0, 1.0) : 0;
  const glm::dvec3 tangent = glm::mix(segment.tangent_at_begin, segment.tangent_at_end, point.share);
  const double length = glm::length(tangent);
  set_axes(point, length > 1e-6 ? tangent / length : axis);
  return point;
}

FibrePoint fibre_point(const strands::CurvePoint& curve, bool is_flat, const strands::RayHit& hit,
                       const glm::dvec3& origin, const glm::dvec3& direction) {
  FibrePoint point{
      .position = origin + hit.distance * direction, .share = hit.share, .from = {hit.strand, hit.vertex, hit.share}};
  const double speed = glm::length(curve.tangent);
  const glm::dvec3 axis = speed > 0 ? curve.tangent / speed : glm::dvec3(1, 0, 0),
                   away = point.position - curve.position;
  const glm::dvec3 across = away - glm::dot(away, axis) * axis, side = glm::cross(axis, -direction);
  const double width = (is_flat ? curve.radius : glm::length(across)) * glm::length(side);
  point.h = width > 0 ? std::clamp(glm::dot(across, side) / width, -1.0, 1.0) : 0;
  set_axes(point, axis);
  return point;
}

FibrePoint fibre_point(const strands::Groom& hair, std::span<const glm::vec3> tangents, const strands::RayHit& hit,
                       const glm::dvec3& origin, const glm::dvec3& direction) {
  const std::uint32_t v = hit.vertex;
  return fibre_point({hair.positions[v], hair.positions[v + 1], tangents[v], tangents[v + 1]}, hit, origin, direction);
}

}  // namespace cuticle::render::reference
