#pragma once
// The light's view of a groom as a map: square texels, depth steps.
#include <cstdint>

#include <glm/vec3.hpp>

#include "shadows/light_frame.h"
#include "shadows/light_frame.glslh"

namespace cuticle::shadows {

/// World to map: x, y in texels, z in depth steps (light_frame.glslh, splat.glslh).
struct MapView {
  LightAxes axes;
  glm::vec3 scale{1}, offset{0};  ///< MapPlacement
  std::uint32_t columns = 16, rows = 16;
  std::size_t texels() const { return std::size_t(columns) * rows; }
};
/// The view that holds the box, `intervals` depth steps deep: at most resolution^2 texels in its shape.
inline MapView map_view(const LightAxes& axes, const LightBox& box, std::uint32_t resolution, float intervals,
                        float least_share = k_any_shape) {
  const MapPlacement<float> placement = map_placement(box.lower, box.upper, resolution, intervals, least_share);
  return {axes, placement.scale, placement.offset, placement.columns, placement.rows};
}
/// A point of the light's view in the map, and a world point, metres.
inline glm::vec3 seen_to_map(const MapView& view, const glm::vec3& seen) {
  return place_in_map(MapPlacement<float>{view.scale, view.offset, view.columns, view.rows}, seen);
}
inline glm::vec3 to_map(const MapView& view, const glm::vec3& p) { return seen_to_map(view, view_point(view.axes, p)); }

}  // namespace cuticle::shadows
