#include "sim/telemetry.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace cuticle::sim {
namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Error not_finite(std::string_view what, const glm::vec3& v, int frame, std::size_t strand, std::size_t vertex) {
  return internal_error(fmt::format("frame {}, strand {}, vertex {}: {} ({}, {}, {}) is not finite", frame, strand,
                                    vertex, what, v.x, v.y, v.z));
}

}  // namespace

Telemetry measure(const strands::Groom& rest, const State& state) {
  Telemetry telemetry{.guards_fired = state.guards_fired};
  for (float tension : state.tensions) telemetry.largest_tension = std::max(telemetry.largest_tension, double(tension));
  for (float bent : curvature(rest, state.positions))
    telemetry.largest_curvature = std::max(telemetry.largest_curvature, double(bent));
  const std::vector<float> ratios = stretch(rest, state.positions);
  double sum = 0, largest = 0;
  std::size_t segments = 0;
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i, ++segments) {
      sum += double(ratios[i]);
      largest = std::max(largest, double(ratios[i]));
    }
  if (segments > 0) {
    telemetry.largest_stretch = largest;
    telemetry.mean_stretch = sum / double(segments);
  }
  return telemetry;
}

Result<void> check_finite(const strands::Groom& rest, const State& state, int frame) {
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s]; i < rest.offsets[s + 1]; ++i) {
      if (!finite(state.positions[i])) return not_finite("position", state.positions[i], frame, s, i - rest.offsets[s]);
      if (!finite(state.velocities[i]))
        return not_finite("velocity", state.velocities[i], frame, s, i - rest.offsets[s]);
    }
  return {};
}

std::string telemetry_header() {
  return "frame,time_s,max_stretch,mean_stretch,max_tension_m2_per_s2,max_curvature_per_m,guards_fired\n";
}

std::string telemetry_row(int frame, double time, const Telemetry& telemetry) {
  return fmt::format("{},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{}\n", frame, time, telemetry.largest_stretch,
                     telemetry.mean_stretch, telemetry.largest_tension, telemetry.largest_curvature,
                     telemetry.guards_fired);
}

}  // namespace cuticle::sim
