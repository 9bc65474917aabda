#pragma once
// Colours of numbers: perceptually uniform from low to high, or diverging from a middle. Needs no VTK.
#include <span>
#include <string>

#include <glm/vec3.hpp>

namespace cuticle::viz {

/// sequential: viridis (Smith and van der Walt 2015, CC0); diverging: cool to warm (Moreland 2009).
enum class Ramp { sequential, diverging };
/// The colour at a fraction 0 .. 1 (beyond: that of the nearer end), sRGB 0 .. 1.
glm::dvec3 ramp_color(Ramp ramp, double fraction);

/// Which number has which colour, and what the numbers are. Numbers that are not finite are light grey.
struct ColorScale {
  Ramp ramp = Ramp::sequential;
  double lower = 0, upper = 1;  ///< lower < upper; logarithmic: both above 0
  bool logarithmic = false;
  std::string title;  ///< with its unit, "stretch [length / rest length]"

  double fraction(double value) const;
  glm::dvec3 color(double value) const;
};

/// The scale of some numbers from their least to their greatest, or as far to both sides of `neutral`; never empty.
ColorScale sequential_scale(std::span<const float> values, std::string title);
ColorScale diverging_scale(std::span<const float> values, double neutral, std::string title);
/// The same with a logarithm, at most `decades` below the greatest.
ColorScale logarithmic_scale(std::span<const float> values, double decades, std::string title);

}  // namespace cuticle::viz
