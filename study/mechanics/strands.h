#pragma once
// Private to study/mechanics: single strands, and solvers that run them.
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/solver.h"

namespace cuticle::study::mechanics {

constexpr double k_g = 9.80665;  ///< m/s^2, the default of "gravity"
/// EI / (rho A) of the default fibre, m^4/s^2: E r^2 / (4 rho).
constexpr double k_bending = 3.9e9 * 3.5e-5 * 3.5e-5 / (4 * 1300);
/// Each frame one substep, whatever its duration; nothing holds or slows the hair but its own laws.
constexpr std::string_view k_one_step = "inner_step=1,max_substeps=1,";
constexpr std::string_view k_free = "shape_stiffness=0,clamped_vertices=1,";            ///< of classic and exact
constexpr std::string_view k_limp = "young_modulus=0,shear_modulus=0,sag_free=false,";  ///< of rod

/// The length of the default fibre at a weight Gamma = rho g A L^3 / (EI), metres.
double length_of(double gamma);

strands::Groom groom_of(const std::vector<glm::dvec3>& places);
strands::Groom straight(int links, double length, const glm::dvec3& direction);

struct Around {
  std::string gravity = "";                   ///< settings of the effect
  std::optional<std::string> colliders = {};  ///< settings; none: no effect
  bool is_weightless = false;
};
Result<std::unique_ptr<sim::Solver>> solver_of(std::string_view name, const strands::Groom& groom,
                                               const std::string& settings, const Around& around = {});

/// The state after so many frames beside these, the head at rest.
Result<sim::State> run_still(sim::Solver& solver, double seconds, double step, const sim::FrameInput& beside = {});
/// The same without a run through time (sim/rod/equilibrium.h), `rod` with these settings. Residual: the largest moment
/// that is not balanced, over weight times length.
struct AtRest {
  std::vector<glm::vec3> positions;
  double residual = 0;
};
Result<AtRest> rest_of(const strands::Groom& groom, const std::string& settings,
                       std::span<const RoundedBox> boxes = {});

/// The fastest vertex, m/s.
double fastest(const sim::State& state);

}  // namespace cuticle::study::mechanics
