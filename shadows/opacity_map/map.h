#pragma once
// N17: opacity shadow maps (Kim and Neumann 2001; Nguyen and Donnelly, GPU Gems 2, chapter 23): sigma at evenly spaced
// slices of the light's view of a groom, T = exp(-k sigma).
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "shadows/map_settings.h"
#include "shadows/map_view.h"
#include "shadows/mean_fibre.h"
#include "shadows/method.h"
#include "shadows/own_fibre.h"
#include "strands/groom.h"

namespace cuticle::shadows::opacity_map {

/// How sigma is summed and stored: integers of 32 bits by compute, or N18, four targets of four channels that are drawn
/// into with additive blending, of 8 bits (sigma 0 .. 1) or of half floats.
enum class Form { compute, graphics_8bit, graphics_half };
/// Planes that four targets of four channels hold.
inline constexpr std::uint32_t k_target_planes = 16;

/// The method's parameters, in SI units.
struct Settings {
  MapSettings map{.method = "opacity_map", .knows_depths = false};
  std::uint32_t slices = 16;     ///< planes, the first of which holds nothing and is not stored
  bool printed_spacing = false;  ///< slices range / n apart, as printed in the source; else range / (n - 1)
  Form form = Form::compute;
  /// N19: tent weights of a point on a segment are interpolated from its ends', as a rasteriser does; else its own.
  bool vertex_weights = false;
  /// What lies between two slices lies there at random depths; else sigma grows evenly, as in the source. Sums that are
  /// proportional to opacity, drawn forms and weights per vertex are even.
  bool scattered = true;
  bool is_scattered() const {
    return scattered && !map.accumulation.poisson && form == Form::compute && !vertex_weights;
  }
  std::uint32_t layers() const { return slices - 1; }
  /// Slice spacings from the near to the far plane of the hair.
  float intervals() const { return float(printed_spacing ? slices : slices - 1); }
  /// Error: usage, when the map would pass 2 GiB, or a drawn one its 16 planes.
  Result<void> check() const;
};
void describe(registry::Members& members, Settings& settings);

/// A filled map: sigma at slice i + 1 of texel t is sums[t * layers + i] / scale.
struct Map {
  MapView view;
  std::uint32_t layers = 15;
  double scale = 1;
  std::size_t texel_bytes = 60;  ///< in the form's own format
  std::size_t clamped = 0;       ///< numbers that the form's range cut off
  std::vector<std::uint32_t> sums;
  std::vector<std::uint32_t> table;  ///< of deposits
  FibreSums fibre{};                 ///< over the sampled segments
  std::size_t bytes() const { return texel_bytes * view.texels(); }
};
/// Fills a map; the same integers at any thread count, and as the GPU's (MapGpu_SameGroom_SameIntegers). The
/// graphics forms are imitated: each deposit (8 bits) or the sum (half) is rounded as the format does
/// (OpacityDrawn_EightBitsAndHalf_StayCloseToTheTwin).
Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings);

/// Transmittance at the receivers, one each, in [0, 1]; outside the map it is 1. Error: usage, for too wide a filter.
Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked);

}  // namespace cuticle::shadows::opacity_map
