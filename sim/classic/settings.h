#pragma once
// The classic solver's parameters as numbers, and the constants of one substep: shared by the CPU twin and the kernels.
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/colliders/contact.h"
#include "sim/head_motion.h"
#include "sim/solver.h"

namespace cuticle::sim::classic {

/// Of a sweep over the constraints: root to tip, or every other segment at once, then the rest (H4).
enum class Order { sequence, red_black };

/// What a sweep of the constraints does.
struct Sweep {
  Order order = Order::sequence;
  bool long_range = true;                 ///< H5
  float sphere_root = 0, sphere_tip = 0;  ///< H6; both 0: no spheres
  bool has_spheres() const { return sphere_root > 0 || sphere_tip > 0; }
};

/// The solver's parameters.
struct Classic {
  static constexpr std::string_view name = "classic";
  double inner_step = 0.004166666666666667;
  std::uint32_t max_substeps = 64, iterations = 4, clamped_vertices = 2;
  double damping = 2, shape_stiffness = 12;
  float shape_tip = 0.5f;
  bool sag_free = true;
  Sweep sweep;
};
void describe(registry::Members& members, Classic& classic);

/// Those, and what the effects that act in it have.
struct Settings : Classic {
  glm::dvec3 gravity{0};                                   ///< m/s^2, less buoyancy; zero without the effect
  Pushes pushes = {};                                      ///< of "wind", "water" and such
  std::optional<colliders::ContactSettings> contact = {};  ///< present with the effect
};
/// Error: usage, naming an effect that this solver does not know.
Result<void> check_effects(const EffectBlocks& effects);
Settings make_settings(const Classic& solver, const EffectBlocks& effects);

std::uint32_t substeps(const Settings& settings, double duration);

/// Constants of one substep; the layout is that of the kernels' push constants.
struct StepConstants {
  glm::vec4 carry{0, 0, 0, 1}, rotation_begin{0, 0, 0, 1}, rotation_end{0, 0, 0, 1};
  glm::vec3 head_step{0};      ///< metres that the head's translation moves
  float velocity_to_step = 0;  ///< h exp(-drag h): what is left of a velocity, as a displacement
  glm::vec3 fall{0};           ///< what gravity, air and water add to the new position, metres
  float shape_rate = 0;        ///< shape stiffness times h, at the root
  float shape_tip = 0;
  float inverse_duration = 0;  ///< 1/h; 0 when no time passes: velocities are kept
  std::uint32_t strand_count = 0, clamped_vertices = 1;
};
StepConstants make_step(const Settings& settings, const Substep& substep, std::uint32_t strand_count);

}  // namespace cuticle::sim::classic
