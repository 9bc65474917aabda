#pragma once
// N17: opacity shadow maps (Kim and Neumann 2001; Nguyen and Donnelly, GPU Gems 2, chapter 23): sigma at evenly spaced
// slices of the light's view of a groom, T = exp(-k sigma).
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <cuticle/shadows/map_settings.h>
#include <cuticle/shadows/map_view.h>
#include <cuticle/strands/groom.h>

namespace cuticle::shadows::opacity_map {

/// The method's parameters, in SI units; ranges are those of its parameter table.
struct Settings {
  MapSettings map;
  std::uint32_t slices = 16;     ///< planes, the first of which holds nothing and is not stored
  bool printed_spacing = false;  ///< slices range / n apart, as printed in the source; else range / (n - 1)
  std::uint32_t layers() const { return slices - 1; }
  /// Slice spacings from the near to the far plane of the hair.
  float intervals() const { return float(printed_spacing ? slices : slices - 1); }
};
/// Error: usage, when the map would pass 2 GiB.
Result<Settings> settings_from(const registry::ParameterValues& values);

/// A filled map: sigma at slice i + 1 of texel t is sums[t * layers + i] / scale.
struct Map {
  MapView view;
  std::uint32_t layers = 15;
  double scale = 1;
  std::vector<std::uint32_t> sums;
};
/// Fills a map; the same integers at any thread count, and as the GPU's (OpacityMapGpu_SameGroom_SameIntegers).
Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings);

/// Transmittance at world points, one each, in [0, 1]; outside the map it is 1. `filter`: radius in texels.
std::vector<float> look_up(const Map& map, const Settings& settings, float filter, std::span<const glm::vec3> points);

}  // namespace cuticle::shadows::opacity_map
