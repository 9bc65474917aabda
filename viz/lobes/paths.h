#pragma once
// Rays through the cross-section of a fibre: R, TT and TRT of parallel light, with the caustic. Needs no VTK.
#include <array>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/result.h"

namespace cuticle::viz {

struct PathsView {
  double eta = 1.55;  ///< refractive index, above 1
  double theta = 0;   ///< inclination of the light, radians: the index in the section is Bravais'
  double aspect = 1;  ///< of the cross-section: the axis across the light over the axis along it
  double turned = 0;  ///< by which the section is turned against the light, radians
  int rays = 25;
};

/// A ray at offset h: where it meets the surface, one point a meeting, and where it leaves to after R, TT and TRT.
struct SectionPath {
  double h = 0;                           ///< offset over half the section's width across the light, -1 .. 1
  std::vector<glm::dvec2> meets = {};     ///< entry, and one point for every inner meeting; the light comes along -x
  std::array<glm::dvec2, 3> leaves = {};  ///< unit directions of R, TT and TRT
  std::array<double, 3> phi{};            ///< their azimuths from back to the light, radians, -pi .. pi
  std::array<double, 3> share{};          ///< of the ray's light, unpolarised, without absorption
};
/// Index in the normal plane, sqrt(eta^2 - sin^2 theta) / cos theta (Marschner et al. 2003, equation 19 in our
/// notation).
double bravais_index(double eta, double theta);
SectionPath trace_section(const PathsView& view, double h);
/// Offset of the caustic of TRT, where d phi / d h is 0: h^2 = (4 - eta'^2) / 3 of a circular section; below 0: none.
double caustic_offset(const PathsView& view);

/// paths.csv: h, phi_R_deg, phi_TT_deg, phi_TRT_deg, share_R, share_TT, share_TRT. Error: bad_input naming the file.
Result<void> write_paths(const PathsView& view, const std::string& folder);

}  // namespace cuticle::viz
