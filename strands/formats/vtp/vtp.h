#pragma once
// Strand states for ParaView and VTK: PolyData files (.vtp) and their time series (.pvd), written as text.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::strands {

/// One state of a groom's strands; every span has one entry per vertex, or none where it may be left out.
struct StrandState {
  const Groom* groom = nullptr;           ///< offsets; its positions are not read
  std::span<const glm::vec3> positions;   ///< metres, world
  std::span<const glm::vec3> velocities;  ///< metres per second
  std::span<const float> stretch;         ///< length over rest length of the segment towards the root
  std::span<const float> tension = {};    ///< of that segment, m^2/s^2; may be left out
  std::span<const float> curvature = {};  ///< 1/m; may be left out
  std::span<const float> contact = {};    ///< signed distance to the nearest collider, metres; may be left out
  std::span<const std::uint32_t> guard_fired = {};  ///< one per strand: whether it was reset; may be left out
};

/// The state as VTK XML PolyData, ASCII: a polyline per strand of two or more vertices; point arrays velocity, stretch,
/// tension, curvature and contact where given, and strand_id; a cell array guard_fired where given. Nine digits: floats
/// read back bit by bit.
std::string format_vtp(const StrandState& state);
/// The unit of an array of these names ("velocity": "m/s"), which the file states for VTK; empty: none is known.
std::string_view state_unit(std::string_view array);
/// The most bytes that format_vtp can give for this groom.
std::size_t vtp_bytes_at_most(const Groom& groom);

/// A member of a time series: seconds, and the file's name relative to the .pvd.
struct SeriesMember {
  double time = 0;
  std::string file;
};
std::string format_pvd(std::span<const SeriesMember> members);

}  // namespace cuticle::strands
