#include "strands/growing/bun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/spline/frame.glslh"

namespace cuticle::strands {

BunFrame::BunFrame(const Bun& bun, const Mesh& mesh, const glm::dvec3& center)
    : bun_(bun), axis_(0, std::cos(bun.tilt), -std::sin(bun.tilt)) {
  double best = -2;
  for (const glm::vec3& position : mesh.positions) {
    const glm::dvec3 offset = glm::dvec3(position) - center;
    const double cosine = glm::dot(offset, axis_) / std::max(glm::length(offset), 1e-9);
    if (cosine <= best) continue;
    best = cosine;
    tie_ = glm::dvec3(position);
  }
  across_ = any_across<double>(axis_);
  beside_ = glm::cross(axis_, across_);
}

glm::dvec3 BunFrame::toward(const glm::dvec3& point) const {
  const glm::dvec3 offset = tie_ - point;
  const double distance = glm::length(offset);
  return distance > 0 ? offset / distance : axis_;
}

bool BunFrame::reaches(const glm::dvec3& point) const {
  const glm::dvec3 offset = point - tie_;
  const double height = glm::dot(offset, axis_);
  return glm::length(offset - height * axis_) < bun_.radius + 0.9 * bun_.thickness && height > -4 * bun_.thickness;
}

glm::dvec3 BunFrame::ring_point(double azimuth, double place, double depth) const {
  using std::numbers::pi;
  const double round = glm::mix(-0.35 * pi, 1.15 * pi, place), along = azimuth + 2 * pi * bun_.turns * place;
  const double thickness = bun_.thickness * (1 - bun_.layers * depth);
  const double from_axis = bun_.radius + thickness * std::cos(round);
  const double height = 0.5 * bun_.thickness + thickness * std::sin(round);
  return tie_ + height * axis_ + from_axis * (std::cos(along) * across_ + std::sin(along) * beside_);
}

void BunFrame::append_ring(double depth, std::vector<glm::dvec3>& points) const {
  constexpr int bridge = 8, steps = 96;
  const glm::dvec3 begin = points.back(), offset = begin - tie_;
  const double azimuth = std::atan2(glm::dot(offset, beside_), glm::dot(offset, across_));
  const glm::dvec3 first = ring_point(azimuth, 0, depth);
  for (int i = 1; i < bridge; ++i) points.push_back(glm::mix(begin, first, double(i) / bridge));
  for (int i = 0; i <= steps; ++i) points.push_back(ring_point(azimuth, double(i) / steps, depth));
}

}  // namespace cuticle::strands
