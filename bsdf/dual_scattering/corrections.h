#pragma once
// What the terms of dual scattering leave out, fitted to path tracing: factors by the albedo of a fibre, the optical
// depth before a point and the thickness of the hair, times factors by albedo and the angle between light and eye.
#include <array>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace cuticle::bsdf::dual_scattering {

/// Optical depths ln(1 / T) of the rows: ln(1 / k_min_transmittance) (k / (k_depths - 1))^2.
constexpr int k_depths = 8;
/// Even steps of sqrt(1 - albedo) from the first to the last, and of ln(thickness).
constexpr int k_albedos = 5, k_thicknesses = 3;
constexpr double k_first_albedo = 0.1, k_last_albedo = 0.95, k_first_thickness = 1, k_last_thickness = 9;
/// Even steps of the cosine of the angle between light and eye, from -1 (the light is behind) to 1.
constexpr int k_angles = 9;
constexpr int k_factors = 3;

/// Factors on light that was sent on and on light that came back (`scattered_light.glslh`), and 4 pi times the radiance
/// of light, per irradiance, that has no direction left. Without corrections: 1, 1, 0.
struct Correction {
  double onward = 1, back = 1, diffuse = 0;
};
/// A point has the product of its depth's and its angle's.
struct Corrections {
  std::array<Correction, k_depths> depths{};
  std::array<Correction, k_angles> angles = [] {
    std::array<Correction, k_angles> ones;
    ones.fill({1, 1, 1});
    return ones;
  }();
};

/// The place of a number in the table: depths, albedos, thicknesses, from the innermost, of each factor in turn; behind
/// them angles and albedos of each factor.
constexpr int k_depth_numbers = k_factors * k_thicknesses * k_albedos * k_depths;
constexpr int k_numbers = k_depth_numbers + k_factors * k_albedos * k_angles;
constexpr int place_of(int factor, int thickness, int albedo, int depth) {
  return ((factor * k_thicknesses + thickness) * k_albedos + albedo) * k_depths + depth;
}
constexpr int place_of_angle(int factor, int albedo, int angle) {
  return k_depth_numbers + (factor * k_albedos + albedo) * k_angles + angle;
}
/// Where a value lies between the rows of an axis; beyond its ends, at them.
struct Between {
  int below = 0;
  double share = 0;  ///< of the way to the next row
};
Between between_depths(double transmittance);
Between between_albedos(double albedo);
Between between_thicknesses(double thickness);
Between between_angles(double cosine);

/// What the hair surrounds: a head lets no light through, where hair alone is hollow.
enum class Within : std::uint8_t { hair_alone, hair_on_head };
/// The toolkit's own tables: k_numbers each; made by bench/multiple_scattering, which says from what.
std::span<const double, k_numbers> fitted_corrections(Within within);

/// Of a fibre with this albedo (a_f + a_b of the average fibre seen from theta_o 0) in hair of this thickness
/// (strands::optical_thickness), linear between the table's rows.
Corrections corrections_of(std::span<const double, k_numbers> table, double albedo, double thickness);

}  // namespace cuticle::bsdf::dual_scattering
