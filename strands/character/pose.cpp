// Clips at a time, and what joints then do to the bind pose.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "strands/character/character.h"
#include "strands/motion/names.h"

namespace cuticle::strands {

namespace {

/// The keys around a time, and the place between them.
struct KeyPlace {
  std::size_t before = 0, after = 0;
  double between = 0, span = 0;
};
KeyPlace key_place(const Track& track, double time) {
  const auto& times = track.times;
  const auto next =
      std::upper_bound(times.begin(), times.end(), time, [](double t, float key) { return t < double(key); });
  if (next == times.begin()) return {};
  const auto before = std::size_t(next - times.begin()) - 1;
  if (next == times.end()) return {before, before, 0, 0};
  const double span = double(*next) - double(times[before]);
  return {before, before + 1, (time - double(times[before])) / span, span};
}

/// Four numbers of a track; the fourth is 0 where it has three. `part` of a cubic spline: 0 in-tangent, 1 value, 2
/// out-tangent.
glm::dvec4 value_at(const Track& track, std::size_t key, std::size_t part) {
  const std::size_t size = track.components();
  const bool is_cubic = track.interpolation == Interpolation::cubic_spline;
  const float* value = track.values.data() + (is_cubic ? 3 * key + part : key) * size;
  return {value[0], value[1], value[2], size == 4 ? value[3] : 0};
}

glm::dquat quaternion(const glm::dvec4& v) {
  const glm::dquat q(v.w, v.x, v.y, v.z);
  return glm::dot(q, q) > 0 ? glm::normalize(q) : glm::dquat(1, 0, 0, 0);
}

/// glTF 2.0, appendix C: the Hermite spline of two keys, tangents in units per second.
glm::dvec4 spline_at(const Track& track, const KeyPlace& place) {
  const double t = place.between, t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * value_at(track, place.before, 1) +
         place.span * (t3 - 2 * t2 + t) * value_at(track, place.before, 2) +
         (3 * t2 - 2 * t3) * value_at(track, place.after, 1) + place.span * (t3 - t2) * value_at(track, place.after, 0);
}

glm::dvec4 sample(const Track& track, double time) {
  const KeyPlace place = key_place(track, time);
  if (track.interpolation == Interpolation::cubic_spline) return spline_at(track, place);
  const glm::dvec4 a = value_at(track, place.before, 0), b = value_at(track, place.after, 0);
  if (track.interpolation == Interpolation::step) return a;
  if (track.target != TrackTarget::rotation) return glm::mix(a, b, place.between);
  const glm::dquat turn = glm::slerp(quaternion(a), quaternion(b), place.between);
  return {turn.x, turn.y, turn.z, turn.w};
}

void apply(const Track& track, double time, Node& node) {
  const glm::dvec4 value = sample(track, time);
  switch (track.target) {
    case TrackTarget::translation:
      node.translation = glm::dvec3(value);
      break;
    case TrackTarget::rotation:
      node.rotation = quaternion(value);
      break;
    case TrackTarget::scale:
      node.scale = glm::dvec3(value);
      break;
  }
}

glm::dmat4 local_transform(const Node& node) {
  const glm::dmat4 turned = glm::translate(glm::dmat4(1), node.translation) * glm::mat4_cast(node.rotation);
  return glm::scale(turned, node.scale);
}

}  // namespace

Result<int> find_clip(const Character& character, std::string_view name) {
  std::string known;
  for (std::size_t i = 0; i < character.clips.size(); ++i) {
    if (equal_ignoring_case(character.clips[i].name, name)) return int(i);
    known += (i == 0 ? "" : ", ") + character.clips[i].name;
  }
  return bad_input(fmt::format("clip '{}' is not in the character; it has: {}", name, known.empty() ? "none" : known),
                   "name one of these clips");
}

std::vector<glm::dmat4> node_transforms(const Character& character, int clip, double time) {
  std::vector<Node> nodes = character.nodes;
  if (clip >= 0)
    for (const Track& track : character.clips[std::size_t(clip)].tracks)
      apply(track, time, nodes[std::size_t(track.node)]);
  std::vector<glm::dmat4> transforms(nodes.size(), glm::dmat4(1));
  for (int index : character.order) {
    const Node& node = nodes[std::size_t(index)];
    const glm::dmat4 local = local_transform(node);
    transforms[std::size_t(index)] = node.parent < 0 ? local : transforms[std::size_t(node.parent)] * local;
  }
  return transforms;
}

std::vector<glm::dmat4> joint_matrices(const Character& character, int clip, double time) {
  const std::vector<glm::dmat4> nodes = node_transforms(character, clip, time);
  const glm::dmat4 from_metres = glm::inverse(character.to_metres);
  std::vector<glm::dmat4> matrices;
  for (std::size_t j = 0; j < character.joints.size(); ++j)
    matrices.push_back(character.to_metres * nodes[std::size_t(character.joints[j])] * character.inverse_bind[j] *
                       from_metres);
  return matrices;
}

double looped(const Clip& clip, double time) {
  if (!(clip.duration > 0) || !std::isfinite(time)) return 0;
  return time - clip.duration * std::floor(time / clip.duration);
}

}  // namespace cuticle::strands
