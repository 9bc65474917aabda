#include "strands/growing/grower.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/growing/random.h"

namespace cuticle::strands {

namespace {

constexpr double k_clearance = 0.003;  ///< metres
constexpr double k_stiffness = 0.009;  ///< length over which hair turns to where it is pulled, metres

HeadFrame head_frame(const Mesh& scalp) {
  glm::dvec3 lower(scalp.positions.front()), upper = lower;
  for (const glm::vec3& position : scalp.positions) {
    lower = glm::min(lower, glm::dvec3(position));
    upper = glm::max(upper, glm::dvec3(position));
  }
  HeadFrame frame;
  frame.unit = std::max(upper.x - lower.x, 1e-6);
  frame.center = {0.5 * (lower.x + upper.x), upper.y - 0.55 * frame.unit, 0.5 * (lower.z + upper.z)};
  return frame;
}

/// +1 or -1 per scalp vertex: the side of the middle plane that its triangles lie on (both copies on the parting
/// differ).
std::vector<double> sides(const Mesh& scalp, const HeadFrame& frame) {
  std::vector<double> sums(scalp.positions.size(), 0);
  for (const auto& triangle : scalp.triangles) {
    double middle = 0;
    for (std::uint32_t corner : triangle) middle += frame.place(scalp.positions[corner]).x;
    for (std::uint32_t corner : triangle) sums[corner] += middle;
  }
  for (double& side : sums) side = side < 0 ? -1 : 1;
  return sums;
}

/// Where the comb pulls at a place of the head: apart and back on the top, down and back at the sides.
glm::dvec3 comb_direction(const glm::dvec3& place, double side, double parting) {
  const double top = glm::smoothstep(0.0, 0.42, place.y);
  const double part = parting * glm::smoothstep(-0.3, 0.2, place.z);
  const double back_at_side = 0.9 * glm::smoothstep(0.02, 0.45, place.z);
  const glm::dvec3 over_top(side * part, -0.1, -0.35 - 0.9 * (1 - part));
  const glm::dvec3 at_side(0, -1, -back_at_side);
  return glm::mix(at_side, over_top, top);
}

}  // namespace

Grower::Grower(const Head& head, const Style& style, const Grooming& grooming)
    : head_(head),
      style_(style),
      grooming_(grooming),
      frame_(head_frame(head.scalp)),
      sides_(sides(head.scalp, frame_)),
      surface_(head.mesh, 0.05 * frame_.unit / 0.15) {
  if (grooming.bun && !head.mesh.positions.empty()) bun_.emplace(*grooming.bun, head.mesh, frame_.center);
}

double Grower::length_of(std::size_t vertex) const {
  const glm::dvec3 root(head_.scalp.positions[vertex]);
  const double front = glm::smoothstep(0.3, 0.5, frame_.place(root).z);
  const double chance = 1 - style_.variation * random_stream(style_.seed, Chance::length, vertex).next_unit();
  return style_.length * chance * glm::mix(1.0, style_.fringe, front) * length_factor(grooming_, root);
}

std::vector<glm::dvec3> Grower::path(std::size_t vertex, double length) const {
  return bun_ ? path_into_bun(vertex) : free_path(vertex, length);
}

std::vector<glm::dvec3> Grower::free_path(std::size_t vertex, double length) const {
  const int steps = int(std::clamp(std::ceil(1.3 * length / 0.0005), 16.0, 100.0));
  const double step = 1.3 * length / steps;
  glm::dvec3 point(head_.scalp.positions[vertex]), direction(head_.scalp.normals[vertex]);
  std::vector<glm::dvec3> points{point};
  for (int i = 0; i < steps; ++i) {
    direction = turned(point, direction, sides_[vertex], i * step, step);
    point = outside(point + direction * step, i * step);
    points.push_back(point);
  }
  return points;
}

std::vector<glm::dvec3> Grower::path_into_bun(std::size_t vertex) const {
  constexpr int most_steps = 300;
  constexpr double step = 0.002;
  glm::dvec3 point(head_.scalp.positions[vertex]), direction(head_.scalp.normals[vertex]);
  std::vector<glm::dvec3> points{point};
  for (int i = 0; i < most_steps && !bun_->reaches(point); ++i) {
    direction = turned(point, direction, sides_[vertex], i * step, step);
    point = outside(point + direction * step, i * step);
    points.push_back(point);
  }
  bun_->append_ring(random_stream(style_.seed, Chance::bun, vertex).next_unit(), points);
  return points;
}

double Grower::length_on(const std::vector<glm::dvec3>& path, double length) const {
  constexpr double shortest = 0.05;  // of the length: hair rooted below the cut stays this long
  double travelled = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!bun_ && path[i].y < style_.cut_height) return std::clamp(travelled, shortest * length, length);
    travelled += glm::distance(path[i - 1], path[i]);
  }
  return bun_ ? travelled : length;
}

glm::dvec3 Grower::outside(glm::dvec3 point, double travelled) const {
  const double clearance = std::min(k_clearance, 0.5 * travelled);
  const SurfaceHit hit = surface_.at(point);
  if (hit.distance < clearance) point += hit.normal * (clearance - hit.distance);
  for (const Sphere& sphere : head_.colliders) {
    const glm::dvec3 offset = point - sphere.center;
    const double distance = glm::length(offset);
    if (distance > 0 && distance < sphere.radius) point = sphere.center + offset * (sphere.radius / distance);
  }
  return point;
}

glm::dvec3 Grower::comb_at(const glm::dvec3& point, double side) const {
  const glm::dvec3 own = bun_ ? bun_->toward(point) : comb_direction(frame_.place(point), side, style_.parting);
  return combed(grooming_, point, own);
}

glm::dvec3 Grower::turned(const glm::dvec3& point, const glm::dvec3& direction, double side, double travelled,
                          double step) const {
  const SurfaceHit hit = surface_.at(point);
  // Hair that has travelled far lies over hair that has not.
  const double height = style_.volume * (0.5 + std::min(travelled / 0.15, 1.0));
  // Under jaw, ears and neck hair hangs free, but not where a tie holds it; fur lies there as elsewhere.
  const double held = bun_ ? 1 : glm::mix(glm::smoothstep(-0.7, -0.3, hit.normal.y), 1.0, style_.under);
  const double near = (1 - glm::smoothstep(0.012, 0.04, hit.distance - height)) * held;
  const auto along_head = [&](const glm::dvec3& v) { return v - near * hit.normal * glm::dot(v, hit.normal); };
  const glm::dvec3 combed = (bun_ ? 1 : near) * along_head(comb_at(point, side));
  const glm::dvec3 lifted = near * hit.normal * glm::clamp((height - hit.distance) / 0.01, -0.7, 1.0);
  const glm::dvec3 pull = style_.comb * (combed + lifted) + style_.droop * 0.8 * along_head(glm::dvec3(0, -1, 0));
  const double turn = (1 - std::exp(-step / k_stiffness)) * std::min(glm::length(pull), 1.0);
  const glm::dvec3 mixed = (1 - turn) * direction + turn * glm::normalize(pull + 1e-9 * direction);
  return glm::length(mixed) > 1e-6 ? glm::normalize(mixed) : direction;
}

}  // namespace cuticle::strands
