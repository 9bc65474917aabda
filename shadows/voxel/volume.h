#pragma once
// Hair as a volume: optical depth per length in cubic cells, marched towards the light.
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "shadows/light_frame.h"
#include "shadows/map_settings.h"
#include "shadows/own_fibre.h"
#include "shadows/voxel/volume.glslh"
#include "strands/groom.h"

namespace cuticle::shadows::voxel {

/// The method's parameters, in SI units.
struct Settings {
  /// resolution: cells along the longest side; filter_radius: rays start from a disc of it
  MapSettings map{.method = "voxel", .resolution = 64, .accumulation = {.poisson = true}};
  bool isotropic = false;  ///< a piece weighs with its mean width, pi/4; else with that which it shows to the light
  /// Error: usage, when the volume could pass 2 GiB.
  Result<void> check() const { return check_map_bytes(map, map.resolution); }
};
void describe(registry::Members& members, Settings& settings);

/// k_units times what a crossing counts as; an opaque one as an optical depth of 16 ln 2.
float units_per_crossing(double alpha, const Settings& settings);
/// The opacity of a crossing that only some rays through a cell make (`crossing_gain`); 0 with
/// accumulate=optical_depth.
float crossing_met_at_random(double alpha, const Settings& settings);

/// The optical depth across each cell is sums / k_units, x fastest.
struct Volume {
  VolumePlacement<float> placement;
  LightAxes axes;
  std::vector<std::uint32_t> sums;
  float crossing_units = 0, crossing_meeting = 0;  ///< what a crossing counts as, and whether rays make it at random
  std::size_t bytes() const { return 4 * sums.size(); }
};

/// Counts each piece of hair, at most half a cell long, in the cell of its middle; the same integers at any thread
/// count, and as the GPU's (MapGpu_SameGroom_SameIntegers).
/// Error: usage, for a point light's view.
Result<Volume> build_volume(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings);

/// Mean transmittance over the rays from each receiver.
std::vector<float> look_up(const Volume& volume, const Settings& settings, const Asked& asked);

}  // namespace cuticle::shadows::voxel
