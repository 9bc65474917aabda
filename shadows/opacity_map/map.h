#pragma once
// N17: opacity shadow maps (Kim and Neumann 2001; Nguyen and Donnelly, GPU Gems 2, chapter 23): sigma at evenly spaced slices
// of the light's view of a groom, T = exp(-k sigma).
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include <cuticle/core/registry/parameter.h>
#include <cuticle/core/result.h>
#include <cuticle/shadows/light_frame.h>
#include <cuticle/strands/groom.h>

namespace cuticle::shadows::opacity_map {

/// The method's parameters, in SI units; ranges are those of its parameter table.
struct Settings {
  std::uint32_t slices = 16;       ///< planes, the first of which holds nothing and is not stored
  std::uint32_t resolution = 256;  ///< texels along each side
  double k = 5.5;                  ///< sigma = optical depth / k
  double filter_texels = 1;        ///< radius of the lookup's disc; under 0.5: the one texel that holds the point
  double filter_radius = 0;        ///< the same in metres, at least half a texel; used instead where it is not 0
  bool poisson = false;            ///< sum alpha c and average sigma; else sum -ln(1 - alpha c) and average T
  bool printed_spacing = false;    ///< slices range / n apart, as printed in the source; else range / (n - 1)
};
/// Error: usage, when the map would pass 2 GiB.
Result<Settings> settings_from(const registry::ParameterValues& values);

/// World to map: x, y in texels, z in slice spacings (light_frame.glslh, splat.glslh).
struct Geometry {
  LightAxes axes;
  glm::vec3 scale{1}, offset{0};          ///< MapPlacement
  std::uint32_t resolution = 16, layers = 15;
};
/// Slice spacings from the near to the far plane of the hair.
float slice_intervals(const Settings& settings);
Geometry map_geometry(const LightAxes& axes, const LightBox& box, const Settings& settings);
/// The lookup's disc in texels, at most 64. Error: usage, naming the filter.
Result<float> filter_texels(const Geometry& geometry, const Settings& settings);

/// Integers per unit of sigma: the largest power of two, 2^12 .. 2^20, at which `segments` crossings of opacity alpha in one
/// texel stay below 2^32.
double fixed_point_scale(double alpha, const Settings& settings, std::size_t segments);
/// What a covered fraction i / k_coverage_steps of a texel deposits, for i = 0 .. k_coverage_steps. An opaque crossing counts as
/// an optical depth of 16 ln 2, T = 2^-16.
std::vector<std::uint32_t> deposit_table(double alpha, const Settings& settings, double scale);

/// A filled map: sigma at slice i + 1 of texel t is sums[t * layers + i] / scale.
struct Map {
  Geometry geometry;
  double scale = 1;
  std::vector<std::uint32_t> sums;
};
/// Fills a map; the same integers at any thread count, and as the GPU's (OpacityMapGpu_SameGroom_SameIntegers).
Map build_map(const strands::Groom& groom, double alpha, const Geometry& geometry, const Settings& settings);

/// Transmittance at world points, one each, in [0, 1]; outside the map it is 1.
std::vector<float> look_up(const Map& map, const Settings& settings, float filter, std::span<const glm::vec3> points);

}  // namespace cuticle::shadows::opacity_map
