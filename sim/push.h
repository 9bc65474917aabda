#pragma once
// What an effect does to all fibres alike, which every solver folds into its integration.
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace cuticle::sim {

/// Acts on a fibre of velocity v with acceleration - drag v.
struct Push {
  glm::dvec3 acceleration{0};  ///< m/s^2
  double drag = 0;             ///< 1/s
  bool operator==(const Push&) const = default;
};
inline Push operator+(const Push& a, const Push& b) { return {a.acceleration + b.acceleration, a.drag + b.drag}; }

/// Of the seconds since the solver was made; finite.
using PushOverTime = std::function<Push(double time)>;

/// What acts on fibres beside gravity, and the share of gravity that is left.
struct Pushes {
  std::vector<PushOverTime> over_time = {};
  double weight_left = 1;
  Push at(double time) const {
    Push sum;
    for (const PushOverTime& push : over_time) sum = sum + push(time);
    return sum;
  }
};

}  // namespace cuticle::sim
