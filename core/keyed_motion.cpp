#include "core/keyed_motion.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace cuticle {
namespace {

Placement between(const MotionKey& a, const MotionKey& b, double time) {
  const double share = (time - a.time) / (b.time - a.time);
  return {glm::normalize(glm::slerp(a.place.rotation, b.place.rotation, share)),
          glm::mix(a.place.position, b.place.position, share)};
}

Result<void> check_key(const MotionKey& key, const std::string& name) {
  const glm::dvec3& at = key.place.position;
  const double length = glm::length(key.place.rotation);
  if (!std::isfinite(key.time) || !std::isfinite(at.x + at.y + at.z))
    return bad_input(
        fmt::format("{}: time {} s, position ({}, {}, {}): must be finite", name, key.time, at.x, at.y, at.z));
  if (!(std::abs(length - 1) <= 1e-3))
    return bad_input(fmt::format("{}: a rotation of length {}, allowed 1 within 0.001", name, length));
  return {};
}

}  // namespace

Placement KeyedMotion::at(double time) const {
  if (keys.empty()) return {};
  const auto after = std::ranges::upper_bound(keys, time, {}, &MotionKey::time);
  if (after == keys.begin()) return keys.front().place;
  if (after == keys.end()) return keys.back().place;
  return between(*(after - 1), *after, time);
}

Placement KeyedMotion::departure(double begin, double end) const {
  auto key = std::ranges::upper_bound(keys, end, {}, &MotionKey::time);
  for (; key - keys.begin() >= 2 && (key - 1)->time > begin; --key)
    if ((key - 1)->time == (key - 2)->time) return (key - 1)->place;
  return at(begin);
}

bool KeyedMotion::rests(double begin, double end) const {
  const Placement place = at(begin);
  const auto first = std::ranges::lower_bound(keys, begin, {}, &MotionKey::time);
  const auto moves = [&](const MotionKey& key) { return key.time <= end && key.place != place; };
  return at(end) == place && std::none_of(first, keys.end(), moves);
}

Result<void> check(const KeyedMotion& motion, std::string_view name) {
  for (std::size_t k = 0; k < motion.keys.size(); ++k) {
    const std::string key = fmt::format("{}.keys[{}]", name, k);
    CUTICLE_TRY(check_key(motion.keys[k], key));
    if (k > 0 && motion.keys[k].time < motion.keys[k - 1].time)
      return bad_input(
          fmt::format("{}: time {} s is before the key above, {} s", key, motion.keys[k].time, motion.keys[k - 1].time),
          "write keys in the order of their times");
  }
  return {};
}

}  // namespace cuticle
