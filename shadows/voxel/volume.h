#pragma once
// Hair as a volume: optical depth per length in cubic cells, marched towards the light.
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <cuticle/core/registry/parameter.h>
#include <cuticle/shadows/method.h>
#include <cuticle/shadows/voxel/volume.glslh>

namespace cuticle::shadows::voxel {

/// The method's parameters, in SI units.
struct Settings {
  std::uint32_t resolution = 64;  ///< cells along the longest side of the hair
  bool anisotropic = true;   ///< a piece weighs with the width that it shows to the light; else with its mean, pi/4
  bool poisson = true;       ///< a crossing counts as alpha; else as -ln(1 - alpha)
  double filter_radius = 0;  ///< metres, of the disc that rays to the light start from; 0: one ray
};
Settings settings_from(const registry::ParameterValues& values);

/// k_units times what a crossing counts as; an opaque one as an optical depth of 16 ln 2.
float units_per_crossing(double alpha, const Settings& settings);

/// The optical depth across each cell is sums / k_units, x fastest.
struct Volume {
  VolumePlacement<float> placement;
  std::vector<std::uint32_t> sums;
};

/// Counts each piece of hair, at most half a cell long, in the cell of its middle; the same integers at any thread
/// count.
Volume build_volume(const strands::Groom& groom, double alpha, const glm::dvec3& unit_to_light,
                    const Settings& settings);

/// Mean transmittance over the rays from each point.
std::vector<float> look_up(const Volume& volume, const Settings& settings, const glm::dvec3& unit_to_light,
                           std::span<const glm::vec3> points);

}  // namespace cuticle::shadows::voxel
