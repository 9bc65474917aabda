#include "sim/classic/particles.h"

#include <cmath>

#include "sim/classic/verlet.glslh"

namespace cuticle::sim::classic {
namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void reset(const Particles& p, const StepConstants& step) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::vec3 target = p.target(i, step.rotation_begin), next = p.target(i, step.rotation_end);
    p.positions[i] = next;
    p.velocities[i] = (next - target + step.head_step) * step.inverse_duration;
  }
}

}  // namespace

void integrate(const Particles& p, const StepConstants& step) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::vec3 carry(step.carry);
    const glm::vec3 here = turned(p.positions[i], carry, step.carry.w);
    const glm::vec3 velocity = turned(p.velocities[i], carry, step.carry.w);
    const glm::vec3 target =
        turned(glm::vec3(p.begin_places[i]), glm::vec3(step.rotation_begin), step.rotation_begin.w);
    const glm::vec3 next = p.target(i, step.rotation_end);
    const float pull = kept(shape_rate_at(step.shape_rate, step.shape_tip, p.traits[i].y));
    const glm::vec3 moved =
        verlet_position(here, velocity * step.velocity_to_step, target, next, step.head_step, pull, step.fall);
    p.starts[i] = here;
    p.velocities[i] = velocity;
    p.positions[i] = p.traits[i].x > 0 ? moved : next;
  }
}

bool finish(const Particles& p, const StepConstants& step) {
  bool good = true;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (step.inverse_duration > 0)
      p.velocities[i] = (p.positions[i] - p.starts[i] + step.head_step) * step.inverse_duration;
    good = good && finite(p.positions[i]) && finite(p.velocities[i]);
  }
  if (!good) reset(p, step);
  return !good;
}

}  // namespace cuticle::sim::classic
