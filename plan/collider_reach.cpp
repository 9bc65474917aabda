#include "plan/collider_reach.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/colliders/distance_field.h"
#include "sim/head_motion.h"

namespace cuticle::plan {

namespace {

double length_of(const strands::Groom& rest, std::size_t strand) {
  double length = 0;
  for (std::size_t i = rest.offsets[strand] + 1; i < rest.offsets[strand + 1]; ++i)
    length += double(glm::distance(rest.positions[i - 1], rest.positions[i]));
  return length;
}

bool overlap(const ReachBall& a, const ReachBall& b) {
  return glm::distance(a.centre, b.centre) <= a.radius + b.radius;
}

ReachBall around(const Sphere& sphere) { return {sphere.center, sphere.radius}; }
ReachBall around(const RoundedBox& box) { return {box.center, glm::length(box.half_size) + box.radius}; }
ReachBall around(const sim::FieldPointer& field) {
  return {field->centre, 0.5 * field->spacing * glm::length(glm::dvec3(field->cells))};
}

/// Of colliders that the head carries, in its rest space.
std::vector<ReachBall> carried_balls(const sim::FrameInput& input) {
  std::vector<ReachBall> balls;
  for (const Sphere& sphere : input.colliders) balls.push_back(around(sphere));
  for (const RoundedBox& box : input.boxes) balls.push_back(around(box));
  for (const sim::FieldPointer& field : input.fields) balls.push_back(around(field));
  return balls;
}

/// Of colliders that move by themselves, at the begin and end of every substep, in the head's rest space as it stands
/// then. Between the two ends a collider stays within the greater of their radii and half its way.
std::vector<ReachBall> moving_balls(const sim::FrameInput& input, std::size_t substeps) {
  std::vector<const sim::MovingCollider*> colliders;
  for (const sim::MovingCollider& collider : input.moving) colliders.push_back(&collider);
  const std::vector<sim::MovingPart> parts = sim::moving_parts(input, colliders, substeps);
  const sim::HeadWay head(input);
  std::vector<ReachBall> balls;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double step = double(k / colliders.size());
    const ReachBall own =
        std::visit([](const auto& shape) { return around(shape); }, colliders[k % colliders.size()]->shape);
    const auto in_rest = [&](const Placement& place, double at) {
      return glm::inverse(head.turn(at / double(substeps))) * place.of(own.centre);
    };
    const glm::dvec3 begin = in_rest(parts[k].begin, step), end = in_rest(parts[k].end, step + 1);
    balls.push_back({0.5 * (begin + end), own.radius + glm::distance(begin, end)});
  }
  return balls;
}

}  // namespace

std::vector<ReachBall> reach_balls(const strands::Groom& rest, double pearl) {
  std::vector<ReachBall> balls;
  for (std::size_t first = 0; first < rest.strand_count(); first += k_reach_chunk) {
    const std::size_t end = std::min(first + k_reach_chunk, rest.strand_count());
    glm::dvec3 lower(INFINITY), upper(-INFINITY);
    double longest = 0;
    for (std::size_t s = first; s < end; ++s) {
      if (rest.strand_size(s) == 0) continue;
      const glm::dvec3 root(rest.positions[rest.offsets[s]]);
      lower = glm::min(lower, root);
      upper = glm::max(upper, root);
      longest = std::max(longest, length_of(rest, s));
    }
    if (lower.x > upper.x) lower = upper = glm::dvec3(0);
    balls.push_back({0.5 * (lower + upper), 0.5 * glm::distance(lower, upper) + k_reach_of_length * longest + pearl});
  }
  return balls;
}

std::vector<bool> chunks_in_reach(std::span<const ReachBall> balls, const sim::FrameInput& input,
                                  std::size_t substeps) {
  std::vector<ReachBall> colliders = carried_balls(input);
  if (!input.moving.empty()) {
    const std::vector<ReachBall> moving = moving_balls(input, std::max<std::size_t>(substeps, 1));
    colliders.insert(colliders.end(), moving.begin(), moving.end());
  }
  std::vector<bool> reached(balls.size());
  for (std::size_t k = 0; k < balls.size(); ++k)
    reached[k] = std::ranges::any_of(colliders, [&](const ReachBall& collider) { return overlap(balls[k], collider); });
  return reached;
}

bool within_reach(std::span<const ReachBall> balls, const strands::Groom& rest, std::span<const glm::vec4> places,
                  const glm::dmat4& head) {
  for (std::size_t k = 0; k < balls.size(); ++k) {
    const glm::dvec3 centre(head * glm::dvec4(balls[k].centre, 1));
    const std::size_t first = rest.offsets[k * k_reach_chunk],
                      end = rest.offsets[std::min((k + 1) * k_reach_chunk, rest.strand_count())];
    for (std::size_t i = first; i < end; ++i)
      if (glm::distance(glm::dvec3(places[i]), centre) > balls[k].radius) return false;
  }
  return true;
}

}  // namespace cuticle::plan
