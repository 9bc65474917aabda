#include "strands/binding/nearest_triangle.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

constexpr std::uint32_t k_leaf = 4;  // triangles

struct Corners {
  glm::dvec3 a, b, c;
};
Corners corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])};
}

glm::dvec3 centre_of(const Mesh& mesh, std::uint32_t triangle) {
  const Corners t = corners_of(mesh, triangle);
  return (t.a + t.b + t.c) / 3.0;
}

/// The place of the point of the segment a b nearest to p, 0 at a, 1 at b.
double place_on_segment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
  const glm::dvec3 edge = b - a;
  const double squared = glm::dot(edge, edge);
  return squared > 0 ? std::clamp(glm::dot(p - a, edge) / squared, 0.0, 1.0) : 0;
}

MeshPoint weighted(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p,
                   const glm::dvec3& weights) {
  MeshPoint found{.weights = weights, .point = a * weights.x + b * weights.y + c * weights.z};
  found.distance = glm::distance(found.point, p);
  return found;
}

double squared_distance(const glm::dvec3& lower, const glm::dvec3& upper, const glm::dvec3& point) {
  const glm::dvec3 offset = glm::max(glm::max(lower - point, point - upper), glm::dvec3(0));
  return glm::dot(offset, offset);
}

}  // namespace

MeshPoint nearest_on_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area = glm::dot(normal, normal);
  if (area > 0) {
    const double v = glm::dot(glm::cross(p - a, c - a), normal) / area;
    const double w = glm::dot(glm::cross(b - a, p - a), normal) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) return weighted(a, b, c, p, {1 - v - w, v, w});
  }
  const double ab = place_on_segment(a, b, p), bc = place_on_segment(b, c, p), ca = place_on_segment(c, a, p);
  MeshPoint best = weighted(a, b, c, p, {1 - ab, ab, 0});
  for (const glm::dvec3& weights : {glm::dvec3(0, 1 - bc, bc), glm::dvec3(ca, 0, 1 - ca)})
    if (const MeshPoint other = weighted(a, b, c, p, weights); other.distance < best.distance) best = other;
  return best;
}

NearestTriangle::NearestTriangle(const Mesh& mesh) : mesh_(mesh) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners corner = corners_of(mesh, t);
    const glm::dvec3 normal = glm::cross(corner.b - corner.a, corner.c - corner.a);
    if (glm::dot(normal, normal) > 0) triangles_.push_back(t);
  }
  if (!triangles_.empty()) build(0, std::uint32_t(triangles_.size()));
}

std::uint32_t NearestTriangle::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = std::uint32_t(nodes_.size());
  const Corners first = corners_of(mesh_, triangles_[begin]);
  Node node{first.a, first.a, begin, end, 0};
  for (std::uint32_t i = begin; i < end; ++i) {
    const Corners t = corners_of(mesh_, triangles_[i]);
    node.lower = glm::min(glm::min(node.lower, t.a), glm::min(t.b, t.c));
    node.upper = glm::max(glm::max(node.upper, t.a), glm::max(t.b, t.c));
  }
  nodes_.push_back(node);
  if (end - begin <= k_leaf) return index;
  const glm::dvec3 side = node.upper - node.lower;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
      [&](std::uint32_t s, std::uint32_t t) { return centre_of(mesh_, s)[axis] < centre_of(mesh_, t)[axis]; });
  build(begin, middle);
  nodes_[index].right = build(middle, end);
  return index;
}

void NearestTriangle::search_leaf(const Node& node, const glm::dvec3& point, MeshPoint& best) const {
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const Corners t = corners_of(mesh_, triangles_[i]);
    MeshPoint found = nearest_on_triangle(t.a, t.b, t.c, point);
    found.triangle = triangles_[i];
    if (found.distance < best.distance) best = found;
  }
}

void NearestTriangle::search(std::uint32_t index, const glm::dvec3& point, MeshPoint& best) const {
  const Node& node = nodes_[index];
  if (squared_distance(node.lower, node.upper, point) >= best.distance * best.distance) return;
  if (node.right == 0) return search_leaf(node, point, best);
  const Node &left = nodes_[index + 1], &right = nodes_[node.right];
  const bool left_first =
      squared_distance(left.lower, left.upper, point) <= squared_distance(right.lower, right.upper, point);
  search(left_first ? index + 1 : node.right, point, best);
  search(left_first ? node.right : index + 1, point, best);
}

MeshPoint NearestTriangle::at(const glm::dvec3& point) const {
  MeshPoint best;
  if (!nodes_.empty()) search(0, point, best);
  return best;
}

}  // namespace cuticle::strands
