#pragma once
// The polar surfaces that a view of lobes draws, as plain numbers. Private to viz.
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "viz/lobes/lobes.h"

namespace cuticle::viz {

/// A closed grid of directions: rows of theta_o from -pi/2 to pi/2, columns of phi from -pi to pi, both ends included.
struct DirectionGrid {
  int rows = 121, columns = 361;
  std::size_t size() const { return std::size_t(rows) * std::size_t(columns); }
  double theta_o(int row) const;
  double phi(int column) const;
};
inline constexpr DirectionGrid k_moving_grid{46, 91};  ///< while a slider moves

/// S of every lobe of a model on a grid: the mean of r, g and b.
struct LobeValues {
  DirectionGrid grid;
  std::vector<std::string> lobes;
  std::vector<std::vector<double>> values;  ///< one vector a lobe
  std::vector<double> sum() const;
};
/// `averaged`: over about six degrees of phi, because of a caustic, which is an infinite peak, only a mean can be
/// drawn; otherwise at the grid's directions, in float. Errors: the model's.
Result<LobeValues> lobe_values(const ShownModel& shown, const LobeSettings& settings, const DirectionGrid& grid,
                               bool averaged);
/// The integral of a lobe's S over the outgoing sphere: the share of the light that it scatters.
double scattered(const DirectionGrid& grid, const std::vector<double>& values);
/// The value at radius 1: the 99.9th percentile of what is shown.
double peak_of(const LobeValues& values, const std::string& shown_lobe);

/// One surface: positions in the fibre's frame (z = the fibre, x = the light's side) and a colour per vertex.
struct LobeSurface {
  std::string name;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> colors;  ///< sRGB, 0 .. 1
};
inline constexpr double k_decades = 3;
/// 0 .. 1; values above the peak are cut (a caustic is infinite).
double surface_radius(double value, double peak, bool logarithmic);
/// One colour for a lobe's name in every view and figure; grey for an unknown name.
glm::dvec3 lobe_color(std::string_view lobe);
/// Error: usage for a lobe that the model lacks.
Result<std::vector<LobeSurface>> make_surfaces(const LobeValues& values, const LobeSettings& settings, double peak);
/// One surface as far as the larger of the two sums, coloured by (second - first) / (second + first).
LobeSurface difference_surface(const LobeValues& first, const LobeValues& second, const LobeSettings& settings,
                               double peak);

}  // namespace cuticle::viz
