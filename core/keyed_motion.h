#pragma once
// A rigid frame that moves by keys.
#include <string_view>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "core/result.h"

namespace cuticle {

/// Where a frame stands: turned, then moved.
struct Placement {
  glm::dquat rotation{1, 0, 0, 0};  ///< unit
  glm::dvec3 position{0};           ///< metres
  glm::dvec3 of(const glm::dvec3& local) const { return position + rotation * local; }
  bool operator==(const Placement&) const = default;
};

struct MotionKey {
  double time = 0;  ///< seconds
  Placement place;
  bool operator==(const MotionKey&) const = default;
};

/// Straight lines, and turns the short way at constant speed (slerp), between keys; at rest before the first and after
/// the last. Two keys at one time are a jump, which happens at that time and is no motion. Without keys: the identity.
struct KeyedMotion {
  std::vector<MotionKey> keys;  ///< times never fall

  /// The place at a time (seconds); after a jump at that very time.
  Placement at(double time) const;
  /// Where the motion that leads to at(end) sets out: at(begin) or, with jumps after `begin`, behind the last of them.
  Placement departure(double begin, double end) const;
  /// Whether it stands at one place from `begin` to `end`.
  bool rests(double begin, double end) const;
  bool operator==(const KeyedMotion&) const = default;
};

/// Error: bad_input naming `name` and the key that is not finite, whose rotation is no unit quaternion within 1e-3 or
/// whose time is before that of the key above.
Result<void> check(const KeyedMotion& motion, std::string_view name);

}  // namespace cuticle
