#include "sim/sleep/sleep.h"

#include <algorithm>

namespace cuticle::sim::sleep {
namespace {

bool same(const Sphere& a, const Sphere& b) { return a.center == b.center && a.radius == b.radius; }
bool same(const RoundedBox& a, const RoundedBox& b) {
  return a.center == b.center && a.axes == b.axes && a.half_size == b.half_size && a.radius == b.radius;
}
bool same(const FieldPointer& a, const FieldPointer& b) { return a == b; }

/// Whether they are those kept, which they become.
template <class Collider>
bool kept(std::vector<Collider>& before, std::span<const Collider> now) {
  const bool equal = std::equal(before.begin(), before.end(), now.begin(), now.end(),
                                [](const Collider& a, const Collider& b) { return same(a, b); });
  if (!equal) before.assign(now.begin(), now.end());
  return equal;
}

/// Whether they rest in the frame where they stood, which becomes where they stand.
bool rest(std::vector<Placement>& before, const FrameInput& input) {
  std::vector<Placement> now;
  bool at_rest = true;
  for (const MovingCollider& collider : input.moving) {
    now.push_back(collider.motion.at(input.clock_end));
    at_rest &= collider.motion.rests(input.clock_begin, input.clock_end);
  }
  std::swap(before, now);
  return at_rest && before == now;
}

}  // namespace

/// They become those kept in any case.
bool Watch::keeps_colliders(const FrameInput& input) {
  bool same = kept(colliders_, input.colliders);
  same &= kept(boxes_, input.boxes);
  same &= kept(fields_, input.fields);
  same &= rest(moving_, input);
  return same;
}

void Watch::follow(const FrameInput& input, const std::vector<Push>& pushes, bool on_skin) {
  const bool head_rests = on_skin || (input.head_begin == head_ && input.head_end == head_);
  bool still = started_ && !input.teleport && !pushes.empty() && head_rests;
  for (const Push& push : pushes) {
    still &= push == push_;
    push_ = push;
  }
  head_ = input.head_end;
  started_ = true;
  const bool same_colliders = keeps_colliders(input);
  change_ = !still ? Change::all : same_colliders ? Change::nothing : Change::colliders;
  std::swap(reached_before_, reached_);
  reached_.assign(input.reached.begin(), input.reached.end());
}

bool Watch::wakes(std::size_t strand) const {
  if (change_ != Change::colliders || reached_.empty() || reached_before_.empty()) return change_ != Change::nothing;
  return reached_[strand] != 0 || reached_before_[strand] != 0;
}

}  // namespace cuticle::sim::sleep
