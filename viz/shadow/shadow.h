#pragma once
// A view of shadow methods: their layers in the light's view, transmittance as a volume, optical depth along a ray of
// every method against truth. Needs no VTK.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "shadows/method.h"
#include "viz/color/ramp.h"

namespace cuticle::viz {

struct ShadowView {
  std::string name;
  strands::Groom groom;
  glm::dvec3 to_light{0.5, 1, 0.6};
  double alpha = 0.4;
  int layers = 8;        ///< slices of the opacity map, layers of the deep opacity map
  int resolution = 128;  ///< of both maps
  /// Methods whose optical depth is drawn along the ray beside truth.
  std::vector<std::string> methods = {"opacity_map", "deep_opacity", "voxel", "moments"};
  std::optional<glm::dvec3> through;  ///< a place that the ray to the light passes; none: dark_place
  int truth_rays = 1024;
};

/// A sheet of quads in world space, metres, with an optical depth per corner.
struct Sheet {
  int columns = 0, rows = 0;
  std::vector<glm::vec3> positions;
  std::vector<float> depths;          ///< optical depth that a point of the sheet has before it
  std::vector<std::uint8_t> is_hair;  ///< whether the texel has hair
};
/// The planes of an opacity map, or the ends of the layers of a deep opacity map, from the light on; of at most
/// `most_columns` columns. Errors: the methods'.
Result<std::vector<Sheet>> opacity_sheets(const ShadowView& view, int most_columns);
Result<std::vector<Sheet>> deep_opacity_sheets(const ShadowView& view, int most_columns);

/// Transmittance on a grid of points over the bounds of the hair, x fastest.
struct TransmittanceVolume {
  glm::ivec3 size{0};
  glm::dvec3 origin{0}, spacing{1};
  std::vector<float> values;
};
Result<TransmittanceVolume> transmittance_volume(const ShadowView& view, int cells);

/// Optical depth -ln T along the ray from the light through a place, over the distance from where the ray enters the
/// hair's bounds, metres.
struct DepthCurve {
  std::string method;
  std::vector<std::array<double, 2>> points;
};
/// The ray's two ends.
struct LightRay {
  glm::dvec3 from{0}, to{0};
};
LightRay light_ray(const ShadowView& view);
/// A vertex of the hair that little light reaches: what `through` is where nobody gave it.
Result<glm::dvec3> dark_place(const ShadowView& view);
/// Truth first. A T of 0 is drawn at `k_max_depth`.
inline constexpr double k_max_depth = 12;
Result<std::vector<DepthCurve>> depth_curves(const ShadowView& view);

/// volume.vti (transmittance), opacity_map.vts and deep_opacity.vts (optical_depth), ray.csv. Error: bad_input.
Result<void> write_shadow(const ShadowView& view, const std::string& folder);

}  // namespace cuticle::viz
