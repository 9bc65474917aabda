#pragma once
// The light's view of a groom as a map: square texels, depth steps.
#include <cstdint>

#include <glm/vec3.hpp>

#include <cuticle/shadows/light_frame.h>
#include <cuticle/shadows/light_frame.glslh>

namespace cuticle::shadows {

/// World to map: x, y in texels, z in depth steps (light_frame.glslh, splat.glslh).
struct MapView {
  LightAxes axes;
  glm::vec3 scale{1}, offset{0};  ///< MapPlacement
  std::uint32_t resolution = 16;
};
/// The view that holds the box, `intervals` depth steps deep.
inline MapView map_view(const LightAxes& axes, const LightBox& box, std::uint32_t resolution, float intervals) {
  const MapPlacement<float> placement = map_placement(box.lower, box.upper, resolution, intervals);
  return {axes, placement.scale, placement.offset, resolution};
}
/// A world point, metres, in the map.
inline glm::vec3 to_map(const MapView& view, const glm::vec3& p) {
  const glm::vec3 light = light_point(view.axes.right, view.axes.up, view.axes.forward, p);
  return place_in_map(MapPlacement<float>{view.scale, view.offset}, light);
}

}  // namespace cuticle::shadows
