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
  for (std::size_t s = 0; s < rest.strand_count(); ++s) {
    const glm::dvec3 root = rest.strand_size(s) == 0 ? glm::dvec3(0) : glm::dvec3(rest.positions[rest.offsets[s]]);
    balls.push_back({root, k_reach_of_length * strands::strand_length(rest, s) + pearl});
  }
  return balls;
}

std::vector<std::uint8_t> hairs_in_reach(std::span<const ReachBall> balls, const sim::FrameInput& input,
                                         std::size_t substeps) {
  std::vector<ReachBall> colliders = carried_balls(input);
  if (!input.moving.empty()) {
    const std::vector<ReachBall> moving = moving_balls(input, std::max<std::size_t>(substeps, 1));
    colliders.insert(colliders.end(), moving.begin(), moving.end());
  }
  std::vector<std::uint8_t> reached(balls.size());
  for (std::size_t k = 0; k < balls.size(); ++k)
    reached[k] = std::ranges::any_of(colliders, [&](const ReachBall& collider) { return overlap(balls[k], collider); });
  return reached;
}

bool within_reach(std::span<const ReachBall> balls, const strands::Groom& rest, std::span<const glm::vec4> places,
                  const glm::dmat4& head) {
  for (std::size_t k = 0; k < balls.size(); ++k) {
    const glm::dvec3 centre(head * glm::dvec4(balls[k].centre, 1));
    for (std::size_t i = rest.offsets[k]; i < rest.offsets[k + 1]; ++i)
      if (glm::distance(glm::dvec3(places[i]), centre) > balls[k].radius) return false;
  }
  return true;
}

}  // namespace cuticle::plan
