#pragma once
// What a run reports of each frame.
#include <string>

#include "sim/solver.h"

namespace cuticle::sim {

/// Stretch is a segment's length over its rest length.
struct Telemetry {
  double largest_stretch = 1, mean_stretch = 1;
  double largest_tension = 0;    ///< m^2/s^2, of State::tensions; 0 without
  double largest_curvature = 0;  ///< 1/m
  std::uint32_t guards_fired = 0;
};
Telemetry measure(const strands::Groom& rest, const State& state);

/// Error: internal, naming frame, strand and vertex of the first position or velocity that is not finite.
Result<void> check_finite(const strands::Groom& rest, const State& state, int frame);

/// Columns frame, time_s, max_stretch, mean_stretch (both lengths over rest lengths), max_tension_m2_per_s2,
/// max_curvature_per_m, guards_fired.
std::string telemetry_header();
std::string telemetry_row(int frame, double time, const Telemetry& telemetry);

}  // namespace cuticle::sim
