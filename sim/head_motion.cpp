#include "sim/head_motion.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>

namespace cuticle::sim {
namespace {

constexpr double k_longest_frame = 100;
constexpr double k_rigid_tolerance = 1e-3;

Result<void> check_rotation(std::string_view name, const glm::dmat3& turn) {
  const glm::dmat3 identity = glm::transpose(turn) * turn;
  double worst = std::abs(glm::determinant(turn) - 1);
  for (int k = 0; k < 9; ++k) worst = std::max(worst, std::abs(identity[k / 3][k % 3] - (k % 4 == 0 ? 1 : 0)));
  if (!(worst <= k_rigid_tolerance))
    return bad_input(
        fmt::format("{}: differs from a rotation by {:.3g}, allowed 0 .. {}", name, worst, k_rigid_tolerance),
        "give a rigid transform, without scale, shear or mirror");
  return {};
}

Result<void> check_transform(std::string_view name, const glm::dmat4& transform) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(transform[column][row]))
        return bad_input(fmt::format("{}: element ({}, {}) is not finite", name, row, column));
  return check_rotation(name, glm::dmat3(transform));
}

Result<void> check_sphere(const std::string& name, const Sphere& sphere) {
  const bool finite =
      std::isfinite(sphere.center.x) && std::isfinite(sphere.center.y) && std::isfinite(sphere.center.z);
  if (!finite || !std::isfinite(sphere.radius) || sphere.radius < 0)
    return bad_input(fmt::format("{}: centre ({}, {}, {}), radius {}: must be finite, radius at least 0", name,
                                 sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius));
  return {};
}

Result<void> check_box(const std::string& name, const RoundedBox& box) {
  CUTICLE_TRY(check_rotation(name + ".axes", box.axes));
  const glm::dvec3 &at = box.center, &half = box.half_size;
  const double least = std::min({half.x, half.y, half.z, box.radius});
  if (!std::isfinite(at.x + at.y + at.z + half.x + half.y + half.z + box.radius) || !(least >= 0))
    return bad_input(
        fmt::format("{}: centre ({}, {}, {}), half size ({}, {}, {}), radius {}: must be finite, sizes at least 0",
                    name, at.x, at.y, at.z, half.x, half.y, half.z, box.radius));
  return {};
}

Result<void> check_field(const std::string& name, const FieldPointer& field) {
  if (!field) return bad_input(fmt::format("{}: null", name));
  return {};
}

Result<void> check_shape(const std::string& name, const MovingCollider& moving) {
  if (const auto* sphere = std::get_if<Sphere>(&moving.shape)) return check_sphere(name, *sphere);
  if (const auto* box = std::get_if<RoundedBox>(&moving.shape)) return check_box(name, *box);
  return check_field(name, std::get<FieldPointer>(moving.shape));
}

Result<void> check_moving(const FrameInput& input) {
  if (!(std::isfinite(input.clock_begin) && std::isfinite(input.clock_end) && input.clock_begin <= input.clock_end))
    return bad_input(fmt::format("clock_begin, clock_end: {} s to {} s, must be finite and not fall", input.clock_begin,
                                 input.clock_end));
  for (std::size_t i = 0; i < input.moving.size(); ++i) {
    const std::string name = fmt::format("moving[{}]", i);
    CUTICLE_TRY(check_shape(name, input.moving[i]));
    CUTICLE_TRY(cuticle::check(input.moving[i].motion, name));
  }
  return {};
}

template <class Collider>
Result<void> check_each(std::string_view name, std::span<const Collider> colliders,
                        Result<void> (*check_one)(const std::string&, const Collider&)) {
  for (std::size_t i = 0; i < colliders.size(); ++i)
    CUTICLE_TRY(check_one(fmt::format("{}[{}]", name, i), colliders[i]));
  return {};
}

Result<void> check(const FrameInput& input) {
  if (!(input.duration >= 0 && input.duration <= k_longest_frame))
    return bad_input(fmt::format("duration: {} s is outside 0 .. {}", input.duration, k_longest_frame));
  CUTICLE_TRY(check_transform("head_begin", input.head_begin));
  CUTICLE_TRY(check_transform("head_end", input.head_end));
  CUTICLE_TRY(check_each("colliders", input.colliders, check_sphere));
  CUTICLE_TRY(check_each("fields", input.fields, check_field));
  CUTICLE_TRY(check_each("boxes", input.boxes, check_box));
  return check_moving(input);
}

glm::dquat rotation_of(const glm::dmat4& transform) { return glm::normalize(glm::quat_cast(glm::dmat3(transform))); }

Placement carried(const Placement& head, const Placement& local) {
  return {head.rotation * local.rotation, head.rotation * local.position};
}
Placement beside(const Placement& head, const Placement& world) {
  return {world.rotation, world.position - head.position};
}

glm::vec4 packed(const glm::dquat& q) { return glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w)); }

}  // namespace

HeadWay::HeadWay(const FrameInput& input)
    : jump(input.teleport || input.duration == 0),
      before(rotation_of(input.head_begin)),
      begin(rotation_of(jump ? input.head_end : input.head_begin)),
      end(rotation_of(input.head_end)),
      from((jump ? input.head_end : input.head_begin)[3]),
      to(input.head_end[3]) {}

std::vector<MovingPart> moving_parts(const FrameInput& input, std::span<const MovingCollider* const> colliders,
                                     std::size_t substeps) {
  const HeadWay way(input);
  const auto time = [&](double share) { return glm::mix(input.clock_begin, input.clock_end, share); };
  std::vector<MovingPart> parts;
  for (std::size_t k = 0; k < substeps; ++k) {
    const double begin = double(k) / double(substeps), end = double(k + 1) / double(substeps);
    const Placement head_begin = way.at(begin), head_end = way.at(end);
    for (const MovingCollider* moving : colliders) {
      const auto place = moving->on_head ? carried : beside;
      parts.push_back({place(head_begin, moving->motion.departure(time(begin), time(end))),
                       place(head_end, moving->motion.at(time(end)))});
    }
  }
  return parts;
}

FrameInput without_head(const FrameInput& input) {
  return {.duration = input.duration,
          .colliders = input.colliders,
          .moving = input.moving,
          .clock_begin = input.clock_begin,
          .clock_end = input.clock_end};
}

Result<void> check_skinned(std::span<const glm::vec3> skinned, std::size_t vertices) {
  if (!skinned.empty() && skinned.size() != vertices)
    return bad_input(fmt::format("skinned: {} places for {} vertices", skinned.size(), vertices));
  for (std::size_t i = 0; i < skinned.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(skinned[i][c])) return bad_input(fmt::format("skinned[{}]: component {} is not finite", i, c));
  return {};
}

std::uint32_t inner_steps(double duration, double inner_step, std::uint32_t most) {
  const double rounded = std::ceil(duration / inner_step * (1 - 1e-9));  // 1/30 s is 8 steps of 1/240 s, not 9
  if (!(rounded > 1)) return 1;  // also for a duration that is no number, which the solver then refuses
  return static_cast<std::uint32_t>(std::min(rounded, double(most)));
}

Result<void> HeadMotion::follow(Carrier carrier) {
  if (carrier_ != Carrier::none && carrier_ != carrier)
    return usage_error("skinned: a solver's frames are all on a skin or none");
  carrier_ = carrier;
  return {};
}

Result<void> HeadMotion::check_shapes(const FrameInput& input) const {
  const bool all_spheres = std::ranges::all_of(
      input.moving, [](const MovingCollider& moving) { return std::holds_alternative<Sphere>(moving.shape); });
  if (meets_all_ || (input.boxes.empty() && input.fields.empty() && all_spheres)) return {};
  return usage_error(
      fmt::format("{}: the solver meets spheres only", !input.boxes.empty()    ? "boxes"
                                                       : !input.fields.empty() ? "fields (mesh colliders)"
                                                                               : "moving"),
      "capsules, boxes and meshes need the solver exact or rod");
}

Result<std::vector<Substep>> HeadMotion::advance(const FrameInput& input, std::uint32_t substeps) {
  if (!input.skinned.empty())
    return usage_error("skinned: this solver follows a head only", "choose the solver 'classic'");
  CUTICLE_TRY(check_shapes(input));
  CUTICLE_TRY(check(input));
  CUTICLE_TRY(follow(Carrier::head));
  return cut(input, substeps);
}

Result<std::vector<Substep>> HeadMotion::advance_on_skin(const FrameInput& input, std::uint32_t substeps) {
  const FrameInput still = without_head(input);
  CUTICLE_TRY(check_shapes(input));
  CUTICLE_TRY(check(still));
  CUTICLE_TRY(follow(Carrier::skin));
  const bool onto_skin = !placed_ || input.teleport || input.duration == 0;
  std::vector<Substep> parts = cut(still, substeps);
  parts[0].onto_skin = onto_skin;
  return parts;
}

std::vector<Substep> HeadMotion::cut(const FrameInput& input, std::uint32_t substeps) {
  const HeadWay way(input);
  const double step = input.duration / substeps;
  std::vector<Substep> parts(substeps);
  for (std::uint32_t k = 0; k < substeps; ++k) {
    parts[k].duration = static_cast<float>(step);
    parts[k].gravity_factor = static_cast<float>(step * (step + (k == 0 ? previous_duration_ : step)) / 2);
    parts[k].rotation_begin = packed(way.turn(double(k) / substeps));
    parts[k].rotation_end = packed(way.turn(double(k + 1) / substeps));
    parts[k].translation_step = glm::vec3((way.to - way.from) / double(substeps));
    parts[k].translation = glm::vec3(way.to);
    parts[k].time = time_ + input.duration * (k + 1) / substeps;
  }
  const glm::dquat jump_turn = way.jump ? way.end * glm::conjugate(way.before) : glm::dquat(1, 0, 0, 0);
  if (way.jump || !placed_) parts[0].carry = packed(placed_ ? jump_turn : way.begin);
  placed_ = true;
  if (step > 0) previous_duration_ = step;
  time_ += input.duration;
  return parts;
}

}  // namespace cuticle::sim
