#include "bsdf/dual_scattering/corrections.h"

#include <algorithm>
#include <cmath>

#include "bsdf/dual_scattering/scattered_light.glslh"

namespace cuticle::bsdf::dual_scattering {

namespace {

Between between(double steps, int rows) {
  const double at = std::clamp(steps, 0.0, rows - 1.0);
  const int below = std::min(int(at), rows - 2);
  return {below, at - below};
}

}  // namespace

Between between_depths(double transmittance) {
  const double deepest = -std::log(double(k_min_transmittance)),
               depth = -std::log(std::max(transmittance, double(k_min_transmittance)));
  return between(std::sqrt(std::max(depth, 0.0) / deepest) * (k_depths - 1), k_depths);
}

Between between_albedos(double albedo) {
  const double lost = std::sqrt(std::clamp(1 - albedo, 0.0, 1.0));
  return between((lost - k_first_albedo) / (k_last_albedo - k_first_albedo) * (k_albedos - 1), k_albedos);
}

Between between_thicknesses(double thickness) {
  const double share =
      std::log(std::max(thickness, 1e-6) / k_first_thickness) / std::log(k_last_thickness / k_first_thickness);
  return between(share * (k_thicknesses - 1), k_thicknesses);
}

Between between_angles(double cosine) { return between((cosine + 1) / 2 * (k_angles - 1), k_angles); }

Corrections corrections_of(std::span<const double, k_numbers> table, double albedo, double thickness) {
  const Between a = between_albedos(albedo), t = between_thicknesses(thickness);
  const auto between_albedos_of = [&](auto&& place) {
    return std::lerp(table[std::size_t(place(a.below))], table[std::size_t(place(a.below + 1))], a.share);
  };
  const auto of_depth = [&](int factor, int depth) {
    const auto at = [&](int dt) {
      return between_albedos_of([&](int albedo) { return place_of(factor, t.below + dt, albedo, depth); });
    };
    return std::lerp(at(0), at(1), t.share);
  };
  const auto of_angle = [&](int factor, int angle) {
    return between_albedos_of([&](int albedo) { return place_of_angle(factor, albedo, angle); });
  };
  Corrections corrections;
  for (int k = 0; k < k_depths; ++k)
    corrections.depths[std::size_t(k)] = {of_depth(0, k), of_depth(1, k), of_depth(2, k)};
  for (int k = 0; k < k_angles; ++k)
    corrections.angles[std::size_t(k)] = {of_angle(0, k), of_angle(1, k), of_angle(2, k)};
  return corrections;
}

}  // namespace cuticle::bsdf::dual_scattering
