#pragma once
// G3: deep opacity maps (Yuksel and Keyser 2008): sigma in layers that start at the nearest fibre of each texel of the
// light's view, T = exp(-k sigma).
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_settings.h"
#include "shadows/map_view.h"
#include "shadows/own_fibre.h"
#include "strands/groom.h"

namespace cuticle::shadows::deep_opacity {

/// How the ends of the layers are spread over the depth of the hair behind its nearest surface.
enum class Spacing { equal_opacity, geometric, equal };

/// The method's parameters, in SI units.
struct Settings {
  MapSettings map{.method = "deep_opacity"};
  std::uint32_t layers = 16;
  Spacing spacing = Spacing::equal_opacity;
  bool by_texel = true;    ///< layers divide the hair of each texel; else all texels have the same
  bool bytes = false;      ///< T before each layer's end in 8 bits; else sigma in 32
  bool sparse = false;     ///< only tiles of 4 x 4 texels that hold hair are stored
  double tile_share = 1;   ///< of all tiles of the resolution: room for those that are stored
  double first_layer = 0;  ///< of geometric spacing, as a share of the depth; 0: 1/32 up to 4 layers, 1/128 beyond
  Result<void> check() const { return check_map_bytes(map, layers + 1); }
};
void describe(registry::Members& members, Settings& settings);

/// Ends of the layers as shares of the depth, of equal_opacity of the hair, 0 .. 65536.
std::vector<std::uint32_t> layer_shares(const Settings& settings);

/// A filled map: sigma before the end of layer i of texel t is sums[t * layers + i] / scale. Of a sparse one only the
/// texels of tiles that have a slot are there (tiles.h).
struct Map {
  MapView view;
  double scale = 1;
  LayerEnds ends{};
  bool by_texel = true;       ///< as in Settings
  std::uint32_t fibre = 0;    ///< mean coverage of a texel's middle by one fibre: an index of the deposits
  float fibre_exponent = 0;   ///< what that adds to the exponent of T
  float spread_exponent = 0;  ///< of one that lies somewhere in a layer; 0: even hair, where sums are proportional
  std::vector<std::uint32_t> ranges;  ///< nearest and farthest depth step of each texel, or k_no_range
  std::vector<std::uint32_t> sums;
  std::vector<std::uint32_t> codes;  ///< instead of sums, where Settings::bytes: T in 255ths, four a word
  std::vector<std::uint32_t> table;  ///< of deposits
  std::vector<std::uint32_t> slots;  ///< where each tile of a sparse map is stored, or k_no_slot; else empty
  std::size_t clamped = 0;           ///< texels of tiles that found no room
  std::size_t bytes() const { return 4 * (ranges.size() + sums.size() + codes.size() + slots.size()); }
};

/// For code c = 1 .. 255, the largest sum that is rounded to T = c / 255 or more.
std::vector<std::uint32_t> code_thresholds(double k, double scale);
/// The exponents that codes 0 .. 255 stand for: ln(c / 255), half a step above none for 0.
std::vector<float> code_exponents();
std::vector<std::uint32_t> pack(const Map& map, double k);

/// Fills a map; the same integers at any thread count, and as the GPU's (MapGpu_SameGroom_SameIntegers).
Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings);

/// Transmittance at the receivers, one each, in [0, 1]; outside the map it is 1. Each texel that a lookup averages uses
/// its own depths, which are never interpolated. Error: usage, for too wide a filter.
Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked);

}  // namespace cuticle::shadows::deep_opacity
