#pragma once
// The polar surfaces that a view of lobes draws, as plain numbers. Private to viz.
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "viz/viz.h"

namespace cuticle::viz {

/// A closed grid of directions: rows of theta_o from -pi/2 to pi/2, columns of phi from -pi to pi, both ends included.
struct DirectionGrid {
  int rows = 121, columns = 361;
  std::size_t size() const { return std::size_t(rows) * columns; }
  double theta_o(int row) const;
  double phi(int column) const;
};

/// One surface: positions in the fibre's frame (z = the fibre, x = the light's side) and a colour per vertex.
struct LobeSurface {
  std::string name;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> colors;  ///< sRGB, 0 .. 1
};
struct LobeSurfaces {
  DirectionGrid grid;
  std::vector<LobeSurface> surfaces;
  double peak = 0;  ///< the value at radius 1: the 99.9th percentile of S, averaged over 3 degrees of phi
};

inline constexpr double k_decades = 3;
/// 0 .. 1; values above the peak are cut (a caustic is infinite).
double surface_radius(double value, double peak, bool logarithmic);
/// One colour for a lobe's name in every view and figure; grey for an unknown name.
glm::dvec3 lobe_color(std::string_view lobe);
Result<LobeSurfaces> make_surfaces(const LobesView& view);

}  // namespace cuticle::viz
